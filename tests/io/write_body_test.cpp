#include "clench/io/write/write_body.h"

#include <limits>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/io/mesh/write_mesh.h"
#include "support/listening.h"
#include "support/meshes.h"
#include "support/shapes.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;

namespace {

BodySpec some_body() {
  Random random(7);
  BodySpec body;
  body.name = "potato";
  body.shape = Shape::make(potato(random, 0.1), "potato");
  body.material = "rubber";
  body.mass = 0.123456789;
  body.com = Eigen::Vector3d(0.001, -0.0023, 1.0 / 300);
  body.inertia_per_mass = Eigen::Vector3d(1e-3, 1.5e-3, 1.0 / 700).asDiagonal();
  body.elastic_modulus = 1.5e6;
  body.tracker = 3;
  body.appearance.color = {0.25f, 0.5f, 0.75f};
  body.appearance.given = true;
  return body;
}

BodySpec plain_body(const std::string& name, ShapePtr shape = {}) {
  BodySpec body;
  body.name = name;
  body.shape = std::move(shape);
  return body;
}

struct Told {
  std::vector<std::string> list;
  WriteOptions options() {
    WriteOptions o;
    o.diagnostics =
        Listening{.warn = [this](const std::string& sentence) { list.push_back(sentence); }};
    return o;
  }
};

void check_same_mesh(const Mesh& a, const Mesh& b) {
  CHECK(a.vertices == b.vertices);
  CHECK(a.triangles == b.triangles);
}

void check_same_matter(const BodySpec& a, const BodySpec& b) {
  CHECK(a.material == b.material);
  CHECK(a.mass == b.mass);
  CHECK(*a.com == *b.com);
  CHECK(*a.inertia_per_mass == *b.inertia_per_mass);
  CHECK(a.elastic_modulus == b.elastic_modulus);
  CHECK(a.tracker == b.tracker);
}

}  // namespace

TEST_CASE("meshes come back from .obj, .off and .ply to the bit, from .stl to 32 bits") {
  const TemporaryFolder folder;
  Random random(1);
  const Mesh mesh = potato(random, 0.1);
  for (const char* name : {"a.obj", "a.off", "a.ply", "A.PLY", "a.stl"}) {
    CAPTURE(name);
    write_mesh(mesh, folder.path() / name);
    const Mesh again = read_body(folder.path() / name).shape->mesh();
    if (std::string(name) != "a.stl") {
      check_same_mesh(mesh, again);
      continue;
    }
    // it names corners, not vertices
    REQUIRE(again.triangles.size() == mesh.triangles.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        CHECK(again.corners(t)[k] == mesh.corners(t)[k].cast<float>().cast<double>());
  }
}

TEST_CASE("a body as .xml comes back to the bit, but for its color, of which it is told") {
  const TemporaryFolder folder;
  const BodySpec body = some_body();
  Told told;
  write_body(body, folder.path() / "a.xml", told.options());
  const BodySpec again = read_body(folder.path() / "a.xml");
  check_same_mesh(body.shape->mesh(), again.shape->mesh());
  check_same_matter(body, again);
  CHECK(told.list == std::vector<std::string>{"a.xml does not hold color"});
}

TEST_CASE("triangles that vanish in 32 bits are counted") {
  const TemporaryFolder folder;
  BodySpec body;
  Mesh mesh = test::box(1, 1, 1);
  // a corner cut off by less than the resolution of 32 bits
  const int n = static_cast<int>(mesh.vertices.size());
  for (auto& p : mesh.vertices) p += Eigen::Vector3d(100, 100, 100);
  const Eigen::Vector3d corner = mesh.vertices[0];
  for (int i = 0; i < 3; ++i) mesh.vertices.push_back(corner + 1e-9 * Eigen::Vector3d::Unit(i));
  mesh.triangles.push_back({n, n + 1, n + 2});
  body.shape = Shape::make(std::move(mesh));
  Warnings told;
  write_body(body, folder.path() / "a.iv", {.diagnostics = told.options().diagnostics});
  REQUIRE(!told.list.empty());
  CHECK(told.list[0] ==
        "a.iv: coordinates keep 32 bits, as .iv holds them; a triangle is too small for them, and "
        "vanishes");
}

TEST_CASE("a body as .iv keeps its matter to the bit, its color, and 32 bits of coordinates") {
  const TemporaryFolder folder;
  const BodySpec body = some_body();
  Told told;
  write_body(body, folder.path() / "a.iv", told.options());
  const BodySpec again = read_body(folder.path() / "a.iv");
  check_same_matter(body, again);
  CHECK((again.appearance.color - body.appearance.color).norm() < 1e-6);  // 32 bits
  // vertices are in the order in which faces name them
  const Mesh &a = body.shape->mesh(), &b = again.shape->mesh();
  REQUIRE(a.triangles.size() == b.triangles.size());
  for (size_t t = 0; t < a.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)  // half a 32-bit step of 0.1 m is 4e-9 m
      CHECK((a.corners(t)[k] - b.corners(t)[k]).norm() < 1e-8);
  CHECK(told.list == std::vector<std::string>{"a.iv: coordinates keep 32 bits, as .iv holds them"});
}

TEST_CASE("that no file of a body holds its soft layer and Poisson's ratio is told") {
  const TemporaryFolder folder;
  BodySpec body = plain_body("box", Shape::make(box(1, 1, 1), "box"));
  body.elastic_modulus = 1.5e6, body.soft_layer = 0.004, body.poisson_ratio = 0.25;
  for (const char* file : {"a.xml", "a.iv"}) {
    Told told;
    write_body(body, folder.path() / file, told.options());
    CHECK(told.list.front() ==
          std::string(file) + " does not hold soft layer 0.004 m, Poisson's ratio 0.25");
  }
}

TEST_CASE("what a bare mesh does not hold is told") {
  const TemporaryFolder folder;
  Told told;
  write_body(some_body(), folder.path() / "a.obj", told.options());
  CHECK(told.list ==
        std::vector<std::string>{"a.obj does not hold material rubber, mass 0.123456789 kg, center "
                                 "of mass, inertia, elastic modulus 1500000 Pa, tracker, color"});
  told.list.clear();
  write_body(plain_body("box", Shape::make(box(1, 1, 1), "box")), folder.path() / "b.obj",
             told.options());
  CHECK(told.list.empty());
  write_body(plain_body("box", Shape::make(box(20, 1, 1), "box")), folder.path() / "c.obj",
             told.options());
  CHECK(told.list == std::vector<std::string>{
                         "c.obj: it is 20 m large, and .obj names no unit: read it with the "
                         "option unit = \"m\", or it is taken for millimeters"});
}

TEST_CASE("a frame is written where a body may be one") {
  const TemporaryFolder folder;
  BodySpec frame = plain_body("frame");
  frame.mass = 0.5;
  write_body(frame, folder.path() / "a.xml");
  CHECK(read_body(folder.path() / "a.xml").mass == 0.5);
  write_body(frame, folder.path() / "a.iv");
  CHECK(read_body(folder.path() / "a.iv").mass == 0.5);
  CHECK_THROWS_WITH_AS(write_body(frame, folder.path() / "a.stl"),
                       "a.stl: 'frame' has no surface to write", Error);
}

TEST_CASE("what cannot be written is an error, and the old file stays") {
  const TemporaryFolder folder;
  const BodySpec body = some_body();
  CHECK_THROWS_WITH_AS(write_body(body, folder.path() / "a.glb"),
                       "a.glb: expected a body to .xml, .iv, .obj, .off, .ply or .stl, got '.glb'",
                       Error);
  CHECK_THROWS_WITH_AS(write_mesh(body.shape->mesh(), folder.path() / "a.iv"),
                       "a.iv: expected a mesh to .obj, .off, .ply or .stl, got '.iv'", Error);
  const auto file = folder.write("a.stl", "old");
  Mesh far = box(1, 1, 1);
  far.vertices[0].x() = 1e39;
  CHECK_THROWS_WITH_AS(
      write_mesh(far, file),
      "a.stl: expected coordinates within 3.403e+38 m, as .stl holds them, got 1e+39", Error);
  CHECK(std::filesystem::file_size(file) == 3);
  const auto gone = folder.path() / "no/a.obj";
  CHECK_THROWS_WITH_AS(write_body(body, gone),
                       (gone.generic_string() + ": the file cannot be written: no such folder: " +
                        gone.parent_path().generic_string())
                           .c_str(),
                       Error);
}
