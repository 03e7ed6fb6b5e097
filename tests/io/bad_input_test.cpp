// Every file of tests/data/bad/<format>/ is refused with the sentence that stands beside it.
#include <algorithm>

#include "base/text.h"
#include "io/read.h"

using namespace clench;
namespace fs = std::filesystem;

static const fs::path folder = "tests/data/bad";

static void read_any(const fs::path& path) {
  const auto extension = path.extension();
  if (extension == ".cfg")
    read_robot(path);
  else if (extension == ".wld")
    read_world(path);
  else
    read_body(path);
}

static std::vector<fs::path> bad_files(const std::string& format) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder / format))
    if (entry.path().extension() == ".txt")
      out.push_back(fs::path(entry.path()).replace_extension("." + format));
  std::sort(out.begin(), out.end());
  return out;
}

static void check_format(const std::string& format) {
  const auto files = bad_files(format);
  REQUIRE(files.size() > 2);
  for (const auto& file : files) {
    const std::string sentence(trim(read_text(fs::path(file).replace_extension(".txt"))));
    INFO(file.string());
    CHECK_THROWS_WITH_AS(read_any(file), sentence.c_str(), Error);
  }
}

TEST_CASE("a malformed Inventor file is told by file, line, wanted and got") { check_format("iv"); }
TEST_CASE("a malformed VRML file is told by file, line, wanted and got") { check_format("wrl"); }
TEST_CASE("a malformed robot file is told by file, line, wanted and got") { check_format("cfg"); }
TEST_CASE("a malformed world file is told by file, line, wanted and got") { check_format("wld"); }
TEST_CASE("a malformed OBJ file is told by file, wanted and got") { check_format("obj"); }
TEST_CASE("a malformed STL file is told by file, wanted and got") { check_format("stl"); }
TEST_CASE("a malformed PLY file is told by file, wanted and got") { check_format("ply"); }
TEST_CASE("a malformed OFF file is told by file, wanted and got") { check_format("off"); }
TEST_CASE("a malformed glTF file is told by file, wanted and got") { check_format("gltf"); }
TEST_CASE("a malformed GLB file is told by file, wanted and got") { check_format("glb"); }
TEST_CASE("a malformed COLLADA file is told by file, wanted and got") { check_format("dae"); }

TEST_CASE("a format that is not read is refused with the list of those that are") {
  CHECK_THROWS_WITH_AS(read_body("tests/CMakeLists.txt"),
                       "CMakeLists.txt: wanted a body from .xml, .iv, .wrl, .vrml, .off, .ply, "
                       ".obj, .stl, .gltf, .glb or .dae, got '.txt'",
                       Error);
  CHECK_THROWS_WITH_AS(read_robot("tests/CMakeLists.txt"),
                       "CMakeLists.txt: wanted a robot from .cfg, .xml, .urdf or .mjcf, got '.txt'",
                       Error);
  CHECK_THROWS_WITH_AS(read_world("tests/CMakeLists.txt"),
                       "CMakeLists.txt: wanted a world from .wld or .xml, got '.txt'", Error);
}

TEST_CASE("a scale that is no length is refused") {
  ReadOptions options;
  options.mesh_scale = 0;
  CHECK_THROWS_WITH_AS(read_body("tests/data/two_finger/box.iv", options),
                       "read options: mesh_scale: wanted a length > 0 [m], got 0", Error);
  options.mesh_scale = NAN;
  CHECK_THROWS_AS(read_body("tests/data/two_finger/box.iv", options), Error);
}
