#include "clench/io/mesh/mesh_readers.h"

#include "clench/base/error.h"
#include "clench/io/mesh/mesh_files.h"
#include "mesh_writers.h"
#include "support/meshes.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;

static Geometry read_gltf(const std::string& content, const ReadOptions& options = {},
                          const std::string& name = "q.gltf") {
  const TemporaryFolder folder;
  return read_mesh_file(folder.write(name, content), options);
}

static std::string whole_gltf(const Mesh& mesh, const std::string& node = "") {
  return gltf_text(mesh, "data:application/octet-stream;base64," + base64(gltf_buffer(mesh)), node);
}

TEST_CASE("a glTF file is in meters with y up, and has the colors of its materials") {
  const Geometry geometry = read_gltf(whole_gltf(box(1, 2, 4)));
  CHECK(geometry.mesh.bounds().size() == Eigen::Vector3d(1, 2, 4));
  CHECK(geometry.report.format == "glTF");
  CHECK(geometry.report.unit_source == UnitSource::format);
  CHECK(geometry.report.up == 'y');
  CHECK(geometry.appearance.given);
  CHECK(geometry.appearance.color == Eigen::Vector3f(1, 0.5f, 0));
}

TEST_CASE("the buffer of a glTF file may be a file of its own, its name written with percents") {
  const TemporaryFolder folder;
  const Mesh mesh = box(1, 1, 1);
  folder.write("my box.bin", gltf_buffer(mesh));
  const auto file = folder.write("q.gltf", gltf_text(mesh, "my%20box.bin"));
  CHECK(find_faults(read_mesh_file(file, {}).mesh).none());
}

TEST_CASE("nodes of a glTF file move, turn and scale their meshes") {
  const Mesh mesh = box(1, 1, 1);
  // by 3 along the file's y, which is z
  CHECK(read_gltf(whole_gltf(mesh, R"(, "translation": [0, 3, 0])")).mesh.bounds().center() ==
        Eigen::Vector3d(0, 0, 3));
  CHECK(read_gltf(whole_gltf(mesh, R"(, "scale": [1, 2, 3])")).mesh.bounds().size() ==
        Eigen::Vector3d(1, 3, 2));
  CHECK(read_gltf(whole_gltf(mesh, R"(, "matrix": [1,0,0,0, 0,2,0,0, 0,0,1,0, 5,0,0,1])"))
            .mesh.bounds()
            .high == Eigen::Vector3d(5.5, 0.5, 1));
  // a quarter turn about y exchanges x and z of the file
  const Mesh turned =
      read_gltf(whole_gltf(box(1, 2, 4),
                           R"(, "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476])"))
          .mesh;
  CHECK((turned.bounds().size() - Eigen::Vector3d(2, 1, 4)).norm() < 1e-12);  // rounding of 1
  // a mirrored mesh still faces outward
  Warnings warnings;
  CHECK_FALSE(
      read_gltf(whole_gltf(mesh, R"(, "scale": [-1, 1, 1])"), warnings.options()).report.flipped);
  CHECK(warnings.list.empty());
}

TEST_CASE("what is wrong in a glTF file is told by the name of its value") {
  const std::string good = whole_gltf(box(1, 1, 1));
  const auto refused = [&](const std::string& what, const std::string& by,
                           const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_gltf(replaced(good, what, by)), ("q.gltf" + sentence).c_str(), Error);
  };
  CHECK_THROWS_WITH_AS(read_gltf("{\n\"asset\": x}"),
                       "q.gltf:2: expected JSON, got something else at byte 12 of it", Error);
  CHECK_THROWS_WITH_AS(read_gltf("[]"), "q.gltf: expected a JSON object, got a JSON array", Error);
  CHECK_THROWS_WITH_AS(read_gltf("{}"), "q.gltf: expected asset.version 2.0, got none", Error);
  refused("2.0", "1.0", ": expected glTF of version 2, got '1.0'");
  refused("\"scene\": 0", "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"]",
          ": it cannot be read without the extension 'KHR_draco_mesh_compression', which is not "
          "supported");
  refused("\"scene\": 0", "\"scene\": 1", ": scene: expected one of 1 scenes, got 1");
  refused("\"nodes\": [0]", "\"nodes\": [2]", ": nodes: expected one of 2 nodes, got 2");
  refused("\"nodes\": [0]", "\"nodes\": [\"a\"]", ": scenes[0].nodes[0]: expected a number");
  refused("\"children\": [1]", "\"children\": [0]",
          ": nodes[0]: expected nodes to form a tree, got one with two parents or in a circle");
  refused("\"mesh\": 0", "\"mesh\": 1", ": nodes[1]: expected one of 1 meshes, got 1");
  refused("\"mesh\": 0", "\"mesh\": 0, \"scale\": [1, 2]",
          ": nodes[1].scale: expected 3 numbers, got 2");
  refused("\"mesh\": 0", "\"mesh\": 0, \"scale\": [1, 2, \"3\"]",
          ": nodes[1].scale[2]: expected a number");
  refused("\"mesh\": 0", "\"mesh\": 0, \"rotation\": [0, 0, 0, 0]",
          ": nodes[1].rotation: expected a unit quaternion");
  refused("\"POSITION\": 0", "\"POSITION\": 1", ": accessors[1]: expected the type VEC3");
  refused("\"indices\": 1", "\"indices\": -1",
          ": meshes[0].primitives[0].indices: expected a whole number from 0 on, got -1");
  refused("\"indices\": 1", "\"indices\": 4000000000",
          ": meshes[0].primitives[0].indices: expected a whole number from 0 to 2147483647, got "
          "'4000000000'");
  refused("\"indices\": 1", "\"indices\": 1, \"extensions\": {\"KHR_draco_mesh_compression\": {}}",
          ": meshes[0].primitives[0]: meshes compressed by Draco are not supported");
  refused("5125", "5126",
          ": accessors[1]: expected indices of an unsigned componentType, got 5126");
  refused("5126", "5124", ": accessors[0]: unknown componentType 5124");
  refused("\"count\": 8", "\"count\": 9",
          ": accessors[0]: expected 108 bytes of bufferViews[0], got 96");
  refused("\"count\": 8", "\"count\": 7",
          ": meshes[0].primitives[0]: expected an index below 7, got 7");
  refused("\"bufferView\": 0, ", "", ": accessors[0]: expected 'bufferView', got none");
  refused("\"bufferView\": 0", "\"sparse\": {}, \"bufferView\": 0",
          ": accessors[0]: sparse accessors are not supported");
  refused("\"byteLength\": 240", "\"byteLength\": 241",
          ": buffers[0]: expected 241 bytes, got 240");
  refused("\"byteLength\": 144", "\"byteLength\": 145",
          ": bufferViews[1]: expected 241 bytes of its buffer, got 240");
  refused("base64,", "base64,!", ": buffers[0].uri: expected data in base64");
  CHECK_THROWS_WITH_AS(read_gltf(gltf_text(box(1, 1, 1), "")),
                       "q.gltf: buffers[0]: expected a uri, got none", Error);
  CHECK_THROWS_WITH_AS(read_gltf(gltf_text(box(1, 1, 1), "no.bin")), "q.gltf: no such file: no.bin",
                       Error);
}

TEST_CASE("what is wrong in the chunks of a GLB file is told in bytes") {
  const std::string good = glb(box(1, 1, 1));
  const auto refused = [](const std::string& bytes, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_gltf(bytes, {}, "q.glb"), ("q.glb: " + sentence).c_str(), Error);
  };
  std::string old = good;
  old[4] = 1;
  refused(old, "expected glTF of version 2, got version 1");
  refused(good.substr(0, 12), "expected a chunk of JSON, got none");
  refused(good.substr(0, good.size() - 10),
          "expected a chunk of 240 bytes, got 230 to the end of the file");
}

TEST_CASE("what a glTF file holds and is not used is told") {
  Warnings warnings;
  std::string text = whole_gltf(box(1, 1, 1), R"(, "skin": 0)");
  text = replaced(text, "\"scene\": 0", "\"scene\": 0, \"animations\": [{}]");
  text =
      replaced(text, "\"primitives\": [", "\"weights\": [1], \"primitives\": [{\"mode\": 1}, {}, ");
  read_gltf(text, warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{
            "q.gltf: its animations are not used", "q.gltf: its morph targets are not used",
            "q.gltf: its points and lines are not used as geometry",
            "q.gltf: its primitives without positions are not used",
            "q.gltf: its skins are not used: skinned meshes keep their shape at rest"});
}

TEST_CASE("a small glTF file that places a mesh many times is refused") {
  std::string text = whole_gltf(ball(1, 60, 60));  // 7080 triangles, 200 times
  std::string nodes = R"({"mesh": 0})", numbers = "0";
  for (int i = 1; i < 200; ++i) {
    nodes += R"(, {"mesh": 0})";
    numbers += ", " + std::to_string(i);
  }
  const auto replace = [&](const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  };
  replace(R"("nodes": [0])", "\"nodes\": [" + numbers + "]");
  replace(R"({"children": [1]}, {"mesh": 0})", nodes);
  CHECK_THROWS_WITH_AS(read_gltf(text),
                       doctest::Contains("expected at most 400000 triangles in a file of its size"),
                       Error);
}
