#include "clench/io/mesh/mesh_readers.h"

#include "clench/base/error.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

static BodySpec read_off_text(const std::string& text, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read_body(folder.write("q.off", text), options);
}

static const std::string off_rows =
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

TEST_CASE("the header of an OFF file may stand in one line, in two, or be the counts alone") {
  for (const std::string head : {"OFF\n4 4 6\n", "OFF 4 4 6\n", "OFF4 4 6\n", "4 4 6\n",
                                 "# a comment\nOFF # another\n\n4 4\n"}) {
    INFO(head);
    const BodySpec body = read_off_text(head + off_rows);
    CHECK(body.shape->faults().none());
    CHECK(body.shape->mesh().triangles.size() == 4);
    CHECK_FALSE(body.appearance.given);
  }
}

TEST_CASE("normals, colors and texture coordinates of OFF vertices are stepped over") {
  const auto with = [](const std::string& kind, const std::string& more) {
    std::string text = kind + "\n4 1 0\n";
    for (const std::string p : {"0 0 0", "1 0 0", "0 1 0", "0 0 1"}) text += p + more + "\n";
    return read_off_text(text + "3 0 1 2\n");
  };
  CHECK(with("NOFF", " 0 0 1").shape->mesh().vertices[1] == Eigen::Vector3d(1, 0, 0));
  CHECK(with("COFF", " 1.0 0.0 0.0 1.0").appearance.color == Eigen::Vector3f(1, 0, 0));
  CHECK(with("CNOFF", " 0 0 1 0 255 0 255").appearance.color == Eigen::Vector3f(0, 1, 0));
  CHECK_FALSE(with("STOFF", " 0.5 0.5").appearance.given);
}

TEST_CASE("colors of OFF faces are shares or bytes") {
  const Appearance look =
      read_off_text(
          "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2 255 0 0\n3 0 2 3 0.0 0.0 1.0 1.0\n")
          .appearance;
  REQUIRE(look.triangle_colors.size() == 2);
  CHECK(look.triangle_colors[0] == Eigen::Vector3f(1, 0, 0));
  CHECK(look.triangle_colors[1] == Eigen::Vector3f(0, 0, 1));
}

TEST_CASE("what is wrong in an OFF file is told by line") {
  const auto refused = [](const std::string& text, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_off_text(text), ("q.off:" + sentence).c_str(), Error);
  };
  refused("", "1: expected 'OFF', got the end of the file");
  refused("OFT\n", "1: expected 'OFF', got 'OFT'");
  refused("4OFF\n", "1: expected OFF of three dimensions, got '4OFF'");
  refused("OFF BINARY\n", "1: expected OFF as text, got binary OFF");
  refused("OFF\n-4 4 6\n", "2: number of vertices: expected a whole number from 0 on, got -4");
  refused("OFF\n4 x 6\n", "2: number of faces: expected a whole number, got 'x'");
  refused("OFF\n4 4 6\n0 0 0\n1 0\n", "4: z: expected a number, got nothing");
  refused("OFF\n4 4 6\n0 0 0\n1 0 inf\n", "4: z: expected a number, got 'inf'");
  refused("OFF\n4 4 6\n0 0 0\n", "3: expected vertex 2 of 4, got the end of the file");
  refused("OFF\n9 4 6\n" + off_rows + "0 0 0\n",
          "11: expected face 1 of 4, got the end of the file");
  refused("OFF\n4 5 6\n" + off_rows, "10: expected face 5 of 5, got the end of the file");
  const std::string points = "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  refused(points + "3 0 1 4\n", "7: expected 3 vertices from 0 to 3, got '4'");
  refused(points + "4 0 1 2\n", "7: expected 4 vertices from 0 to 3, got nothing");
  refused(points + "x 0 1 2\n", "7: corners of a face: expected a whole number, got 'x'");
  refused(points + "3 0 1 2 1 x 0\n", "7: color: expected a number, got 'x'");
  refused("NOFF\n1 0 0\n0 0 0 1 0\n", "3: normal: expected a number, got nothing");
}

TEST_CASE("what an OFF file holds and is not used is told by line, each kind once") {
  Warnings warnings;
  read_off_text("OFF 4 2 0 9\n0 0 0 7\n1 0 0\n0 1 0 7\n0 0 1\n3 0 1 2 5\n2 0 1\nmore\n",
                warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{
            "q.off:1: text after the counts is not used",
            "q.off:2: text after the numbers of a vertex is not used",
            "q.off:6: text after the vertices of a face is no color, and is not used",
            "q.off:7: a face of fewer than three vertices is not used",
            "q.off:8: text after the last face is not used"});
}
