// Every file of tests/data/bad/<format>/ is rejected with the message in the file next to it.
#include "bad_files.h"
#include "read_any.h"

using namespace clench;
using clench::test::check_bad_files;
namespace fs = std::filesystem;

static void check_format(const std::string& format, size_t at_least) {
  check_bad_files(format, "", "." + format, at_least,
                  [](const fs::path& path) { test::read_any(path); });
}

TEST_CASE("a malformed Inventor file is told by file, line, expected and got") {
  check_format("iv", 30);
}
TEST_CASE("a malformed VRML file is told by file, line, expected and got") {
  check_format("wrl", 5);
}
TEST_CASE("a malformed robot file is told by file, line, expected and got") {
  check_format("cfg", 40);
}
TEST_CASE("a malformed world file is told by file, line, expected and got") {
  check_format("wld", 30);
}
TEST_CASE("a malformed OBJ file is told by file, expected and got") { check_format("obj", 5); }
TEST_CASE("a malformed STL file is told by file, expected and got") { check_format("stl", 3); }
TEST_CASE("a malformed PLY file is told by file, expected and got") { check_format("ply", 6); }
TEST_CASE("a malformed OFF file is told by file, expected and got") { check_format("off", 5); }
TEST_CASE("a malformed glTF file is told by file, expected and got") { check_format("gltf", 7); }
TEST_CASE("a malformed GLB file is told by file, expected and got") { check_format("glb", 3); }
TEST_CASE("a malformed COLLADA file is told by file, expected and got") { check_format("dae", 5); }

TEST_CASE("a format that is not read is refused with the list of those that are") {
  CHECK_THROWS_WITH_AS(read_body("tests/CMakeLists.txt"),
                       "CMakeLists.txt: expected a body from .xml, .iv, .wrl, .vrml, .off, .ply, "
                       ".obj, .stl, .gltf, .glb or .dae, got '.txt'",
                       Error);
  CHECK_THROWS_WITH_AS(
      read_robot("tests/CMakeLists.txt"),
      "CMakeLists.txt: expected a robot from .cfg, .xml, .urdf or .mjcf, got '.txt'", Error);
  CHECK_THROWS_WITH_AS(
      read_world("tests/CMakeLists.txt"),
      "CMakeLists.txt: expected a model, a world, or a file that goes with one, got "
      "'.txt'",
      Error);
}

TEST_CASE("a scale that is no length is refused") {
  ReadOptions options;
  options.mesh_scale = 0;
  CHECK_THROWS_WITH_AS(read_body("tests/data/two_finger/box.iv", options),
                       "read options: mesh_scale: expected a length > 0 [m], got 0", Error);
  options.mesh_scale = NAN;
  CHECK_THROWS_AS(read_body("tests/data/two_finger/box.iv", options), Error);
}
