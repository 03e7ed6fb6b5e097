// Mesh files cut at any position, changed at random, and designed to do harm give a mesh or an
// Error that names the file, in short time.
#include <limits>

#include "clench/base/error.h"
#include "clench/geometry/tree/shape.h"
#include "clench/io/mesh/mesh_files.h"
#include "mesh_writers.h"
#include "support/listening.h"
#include "support/meshes.h"
#include "support/mutate.h"

using namespace clench;
using namespace clench::test;

namespace {

/// returns  true if it was rejected
bool refused_mesh(const MeshFile& file, const ReadOptions& options = {}) {
  try {
    const Geometry geometry = read_mesh({file.name, file.content, options});
    // meshes that are read are valid for a Shape and its tree
    CHECK_NOTHROW(Shape::make(geometry.mesh, file.name)->tree());
    return false;
  } catch (const Error& error) {
    CHECK_MESSAGE(std::string(error.what()).starts_with(file.name), error.what());
    return true;
  }
}

const Oddities odd_meshes = {{"-1", "4294967295", "1e308", "nan", "0", "\"", "<", ">", "{", "[",
                              "]", ",", " ", "\n", "#", "/"}};

std::string repeated(const std::string& piece, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += piece;
  return out;
}

}  // namespace

TEST_CASE("a mesh file cut short anywhere is an Error or a mesh") {
  for (const MeshFile& file : in_every_format(box(1, 1, 1))) {
    INFO(file.name);
    const size_t step = std::max<size_t>(1, file.content.size() / 150);
    // an ascii STL file that ends between two facets is read, with a warning
    ReadOptions options;
    int repaired = 0;
    options.diagnostics = Listening{.repair = [&](const std::string& sentence) {
      repaired += sentence.find("expected 'endsolid'") != std::string::npos;
    }};
    int bad = 0, all = 0;
    for (size_t n = 0; n < file.content.size(); n += step, ++all)
      bad += refused_mesh({file.name, file.content.substr(0, n)}, options);
    bad += repaired;
    // lists whose length is not stated may lose their last lines unnoticed
    CHECK(bad * 2 > all);
    if (file.name != "a.obj") CHECK(bad >= all - 2);
  }
}

TEST_CASE("a mesh file changed at random is an Error or a mesh") {
  for (const MeshFile& file : in_every_format(box(1, 1, 1)))
    for (uint64_t i = 0; i < 150; ++i) {
      Random random(17, i);
      const std::string bad = mutated(file.content, odd_meshes, random);
      INFO(file.name << " seed " << i);
      refused_mesh({file.name, bad});
    }
}

TEST_CASE("noise is an Error in every mesh format, behind a sound beginning too") {
  for (const MeshFile& file : in_every_format(box(1, 1, 1)))
    for (uint64_t i = 0; i < 20; ++i) {
      Random random(19, i);
      const std::string bytes = noise(random);
      INFO(file.name << " seed " << i);
      CHECK(refused_mesh({file.name, bytes}));
      const size_t start = random.bits() % (file.content.size() / 2);
      refused_mesh({file.name, file.content.substr(0, start) + bytes});
    }
}

TEST_CASE("numbers beyond the range of lengths are an Error, small ones and far ones are not") {
  for (const double size : {1e-300, 1e-30, 1e-6, 1e6, 1e11})
    CHECK_FALSE(refused_mesh({"a.obj", obj_text(box(size, size, size))}));
  CHECK(refused_mesh({"a.obj", obj_text(box(1e13, 1, 1))}));
  CHECK(refused_mesh({"a.obj", obj_text(box(1e200, 1, 1))}));
  CHECK(refused_mesh({"a.off", off_text(box(1e308, 1e308, 1e308))}));
}

TEST_CASE("elements, nodes and brackets in each other without end are Errors") {
  CHECK(refused_mesh({"a.gltf", repeated("[", 1'000'000)}));
  CHECK(refused_mesh({"a.gltf", "{\"asset\": " + repeated("{\"a\":", 300'000)}));
  CHECK(refused_mesh({"a.dae", repeated("<a>", 300'000)}));
  // a scene that doubles with every node
  std::string nodes;
  for (int i = 0; i < 40; ++i)
    nodes += fmt::format(
        "<node id=\"n{}\"><instance_node url=\"#n{}\"/><instance_node url=\"#n{}\"/></node>", i,
        i + 1, i + 1);
  CHECK(refused_mesh({"a.dae",
                      "<COLLADA><library_visual_scenes><visual_scene><node><instance_"
                      "node url=\"#n0\"/></node></visual_scene></library_visual_scenes>"
                      "<library_nodes>" +
                          nodes + "<node id=\"n40\"/></library_nodes></COLLADA>"}));
  // a chain of nodes as long as the file
  std::string chain = "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [";
  for (int i = 1; i < 20'000; ++i) chain += fmt::format("{{\"children\": [{}]}},", i);
  CHECK(refused_mesh({"a.gltf", chain + "{}]}"}));
}

TEST_CASE("a face of very many corners is cut or refused, in no time") {
  const auto star = [&](int corners, double inner) {
    std::string points, face = "f";
    for (int i = 0; i < corners; ++i) {
      const double a = 2 * std::numbers::pi * i / corners, r = i % 2 ? inner : 1;
      points += fmt::format("v {} {} 0\n", r * std::cos(a), r * std::sin(a));
      face += fmt::format(" {}", i + 1);
    }
    return MeshFile{"a.obj", points + face + "\n"};
  };
  CHECK_FALSE(refused_mesh(star(20'000, 1)));
  CHECK_FALSE(refused_mesh(star(1000, 0.5)));
  CHECK(refused_mesh(star(1002, 0.5)));
}
