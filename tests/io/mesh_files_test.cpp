#include <fmt/format.h>

#include "base/error.h"
#include "io/read.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;

static const std::string cube_points =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
static const std::string cube_faces =
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// The unit cube as an ASCII STL, whose triangles share no points.
static std::string stl_cube() {
  const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const int points[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::string out = "solid cube\n";
  for (const auto& f : faces)
    for (const auto& t : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
      out += "facet normal 0 0 0\nouter loop\n";
      for (const int i : t)
        out += fmt::format("vertex {} {} {}\n", points[i][0], points[i][1], points[i][2]);
      out += "endloop\nendfacet\n";
    }
  return out + "endsolid cube\n";
}

TEST_CASE("an OBJ cube is closed, in metres as written, or in the unit that is given") {
  const TemporaryFolder folder;
  const auto file = folder.write("Cube.OBJ", cube_points + cube_faces);
  const BodySpec b = read_body(file);
  CHECK(b.name == "Cube");
  CHECK(b.shape->mesh().triangles.size() == 12);
  CHECK(b.shape->faults().none());
  CHECK(b.shape->solid().volume == doctest::Approx(1));
  CHECK(b.mass == doctest::Approx(0.3));
  ReadOptions inches;
  inches.mesh_scale = 0.0254;
  CHECK(read_body(file, inches).shape->bounds().high.x() == doctest::Approx(0.0254));
}

TEST_CASE("the loose triangles of an STL are welded") {
  const TemporaryFolder folder;
  const BodySpec b = read_body(folder.write("cube.stl", stl_cube()));
  CHECK(b.shape->mesh().vertices.size() == 8);
  CHECK(b.shape->mesh().triangles.size() == 12);
  CHECK(b.shape->faults().none());
  CHECK_FALSE(b.appearance.given);
}

TEST_CASE("the colours of an OBJ come from its material file and it loads without that too") {
  const TemporaryFolder folder;
  const std::string text = "mtllib cube.mtl\n" + cube_points + "usemtl red\n" + cube_faces;
  const auto file = folder.write("cube.obj", text);
  CHECK(read_body(file).shape);
  folder.write("cube.mtl", "newmtl red\nKd 1 0 0\nd 0.5\n");
  const Appearance look = read_body(file).appearance;
  CHECK(look.given);
  CHECK(look.color == Eigen::Vector3f(1, 0, 0));
  CHECK(look.transparency == 0.5f);
}

TEST_CASE("a point or a face of an OBJ that is wrong is told by line") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& line, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_body(folder.write("q.obj", cube_points + line + "\n" + cube_faces)),
                         ("q.obj:9: wanted " + sentence).c_str(), Error);
  };
  refused("v 1 abc 2", "three numbers after v, got 'abc'");
  refused("v 1 2", "three numbers after v, got nothing");
  refused("v 1 nan 2", "three numbers after v, got 'nan'");
  refused("f 1 2 9", "one of 8 points after f, got 9");
  refused("f 1/1 2/1 0/1", "one of 8 points after f, got 0");
  refused("f -1 -2 -9", "one of 8 points after f, got -9");
  refused("f 1 2 x", "numbers of points after f, got 'x'");
  CHECK(read_body(folder.write("q.obj", cube_points + "f 1 4 3 2\nf -4 -3 -2 -1\n"))
            .shape->mesh()
            .triangles.size() == 4);
}

TEST_CASE("triangles of a mesh file with two equal corners are dropped") {
  const TemporaryFolder folder;
  CHECK(read_body(folder.write("c.obj", cube_points + cube_faces + "f 1 1 2\nf 3 4 3\n"))
            .shape->mesh()
            .triangles.size() == 12);
}
