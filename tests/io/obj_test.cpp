#include "clench/io/mesh/mesh_readers.h"

#include "clench/base/error.h"
#include "support/listening.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

static const std::string cube_points =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
static const std::string cube_faces =
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

static Mesh read_obj_text(const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read_body(folder.write("q.obj", text), options).shape->mesh();
}

TEST_CASE("an OBJ cube is closed, in meters as written, or in the unit that is given") {
  const TemporaryFolder folder;
  const auto file = folder.write("Cube.OBJ", cube_points + cube_faces);
  const BodySpec b = read_body(file);
  CHECK(b.name == "Cube");
  CHECK(b.shape->mesh().triangles.size() == 12);
  CHECK(b.shape->faults().none());
  CHECK(b.shape->solid().volume == doctest::Approx(1));
  CHECK(b.mass == doctest::Approx(0.3));
  CHECK_FALSE(b.appearance.given);
  ReadOptions inches;
  inches.mesh_scale = 0.0254;
  CHECK(read_body(file, inches).shape->bounds().high.x() == doctest::Approx(0.0254));
}

TEST_CASE("the faces of an OBJ may count backwards, stand first, and go on in the next line") {
  const std::string back = "f -8 -5 -6 -7\nf -4 -3 -2 -1\n";
  CHECK(read_obj_text(cube_points + back).triangles.size() == 4);
  CHECK(read_obj_text(cube_faces + cube_points).triangles.size() == 12);
  CHECK(read_obj_text(cube_points + "f 1 4 \\\n3 2\nf 5\\\n 6 7 8 # a face\n").triangles.size() ==
        4);
  CHECK(read_obj_text(cube_points +
                      "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 2//1 4//1\nf 1/1 2/1 5/1\n")
            .triangles.size() == 3);
}

TEST_CASE("an OBJ face that is not convex is cut along its own inside") {
  // an arrowhead: area 1, whereas a fan from its first corner would cover 3
  const Mesh arrow = read_obj_text("v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nf 1 2 3 4\n");
  CHECK(arrow.triangles.size() == 2);
  CHECK(arrow.area() == doctest::Approx(1));
}

TEST_CASE("files of materials without end are not looked for without end") {
  const TemporaryFolder folder;
  std::string text = cube_points + cube_faces;
  for (int i = 0; i < 5000; ++i) text += "mtllib nowhere.mtl\n";
  Warnings warnings;
  CHECK(read_body(folder.write("cube.obj", text), warnings.options()).shape->closed());
  REQUIRE(warnings.list.size() == 1);
  CHECK(warnings.list[0].find("expected at most 1000 files of materials") != std::string::npos);
}

TEST_CASE("the colors of an OBJ come from its material file and it loads without that too") {
  const TemporaryFolder folder;
  const std::string text = "mtllib my cube.mtl\n" + cube_points + "usemtl red\n" + cube_faces;
  const auto file = folder.write("cube.obj", text);
  std::vector<std::string> notes;
  ReadOptions options;
  options.diagnostics =
      test::Listening{.note = [&](const std::string& note) { notes.push_back(note); }};
  options.mesh_scale = 1;
  CHECK_FALSE(read_body(file, options).appearance.given);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "cube.obj:1: no such file: my cube.mtl; the body has one color");
  folder.write("my cube.mtl", "newmtl red\nKd 1 0 0\nd 0.5\nKs 1 1 1\n");
  const Appearance look = read_body(file).appearance;
  CHECK(look.given);
  CHECK(look.color == Eigen::Vector3f(1, 0, 0));
  CHECK(look.transparency == 0.5f);
  Warnings warnings;
  folder.write("my cube.mtl", "newmtl red\nKd 1 x 0\nTr\n");
  read_body(file, warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"my cube.mtl:2: expected three numbers after Kd; not used",
                                 "my cube.mtl:3: expected a number after Tr; not used"});
}

TEST_CASE("a material that no file of an OBJ defines is told once") {
  const TemporaryFolder folder;
  folder.write("red.mtl", "newmtl red\nKd 1 0 0\n");
  Warnings warnings;
  read_body(
      folder.write("cube.obj", "mtllib red.mtl\n" + cube_points +
                                   "usemtl rde\nf 1 2 3\nusemtl red\nusemtl rde\n" + cube_faces),
      warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"cube.obj:10: usemtl: no material 'rde' is defined"});
}

TEST_CASE("colors of the points of an OBJ are those of its triangles") {
  const TemporaryFolder folder;
  const Appearance look =
      read_body(folder.write("q.obj",
                             "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 1 0 0 1\n"
                             "f 1 3 2\nf 1 2 4\n"))
          .appearance;
  CHECK(look.given);
  REQUIRE(look.triangle_colors.size() == 2);
  CHECK(look.triangle_colors[0] == Eigen::Vector3f(1, 0, 0));
  CHECK((look.triangle_colors[1] - Eigen::Vector3f(2, 0, 1) / 3).norm() < 1e-6f);  // 32 bits
}

TEST_CASE("a point or a face of an OBJ that is wrong is told by line") {
  const auto refused = [&](const std::string& line, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_obj_text(cube_points + line + "\n" + cube_faces),
                         ("q.obj:9: expected " + sentence).c_str(), Error);
  };
  refused("v 1 abc 2", "three numbers after v, got 'abc'");
  refused("v 1 2", "three numbers after v, got nothing");
  refused("v 1 nan 2", "three numbers after v, got 'nan'");
  refused("f 1 2 9", "one of 8 points after f, got 9");
  refused("f 1/1 2/1 0/1", "one of 8 points after f, got 0");
  refused("f -1 -2 -9", "one of 8 points after f, got -9");
  refused("f 1 2 x", "numbers of points after f, got 'x'");
  refused("f 1 2 3/x", "numbers of points after f, got '3/x'");
  refused("f 1 2 99999999999", "numbers of points after f, got '99999999999'");
}

TEST_CASE("of too many numbers after v the first three count, with a warning") {
  Warnings warnings;
  const Mesh mesh =
      read_obj_text(cube_points + "v 1 2 3 4 5 6 7 8\n" + cube_faces, warnings.options());
  CHECK(mesh.triangles.size() == 12);
  REQUIRE(!warnings.list.empty());
  CHECK(warnings.list[0] ==
        "q.obj:9: expected at most a point, a weight and a color after v; only the point is used");
}

TEST_CASE("what an OBJ holds and is not used is told by line, each kind once") {
  Warnings warnings;
  read_obj_text(cube_points +
                    "l 1 2\np 1\ncurv 0 1 1 2\nsurf 0 1\nfrob 1\nfrob 2\nf 1 2\ng a b\ns off\n" +
                    cube_faces,
                warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"q.obj:9: lines and points are not used as geometry",
                                 "q.obj:11: free-form curves and surfaces are not used",
                                 "q.obj:13: 'frob' is unknown, and its line is not used",
                                 "q.obj:15: a face of fewer than three points is not used"});
}
