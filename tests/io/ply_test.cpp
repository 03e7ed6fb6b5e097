#include "clench/io/mesh/mesh_readers.h"

#include "clench/base/error.h"
#include "mesh_writers.h"
#include "support/meshes.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;

static BodySpec read_ply_text(const std::string& content, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  return read_body(folder.write("q.ply", content), options);
}

static const std::string vertex_lines =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
static const std::string faces = "element face 2\nproperty list uchar int vertex_index\n";
static const std::string point_rows = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

TEST_CASE("faces, strips and polygons of a PLY file are cut alike") {
  const std::string head = "ply\nformat ascii 1.0\n" + vertex_lines;
  const Mesh two = read_ply_text(head + faces + "end_header\n" + point_rows + "3 0 1 2\n3 2 1 3\n")
                       .shape->mesh();
  const Mesh strip =
      read_ply_text(head +
                    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                    point_rows + "8 0 1 2 3 -1 0 1 3\n")
          .shape->mesh();
  REQUIRE(strip.triangles.size() == 3);
  CHECK(strip.triangles[0] == two.triangles[0]);
  CHECK(strip.triangles[1] == two.triangles[1]);
  CHECK(strip.triangles[2] == Triangle{0, 1, 3});
  CHECK(read_ply_text(head + faces + "end_header\n" + point_rows + "4 0 1 2 3\n3 0 1 3\n")
            .shape->mesh()
            .triangles.size() == 3);
}

TEST_CASE("colors of a PLY file stand at its vertices or its faces") {
  const std::string color = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const std::string head = "ply\nformat ascii 1.0\n" + vertex_lines;
  const Appearance by_face = read_ply_text(head + faces + color + "end_header\n" + point_rows +
                                           "3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n")
                                 .appearance;
  CHECK(by_face.given);
  REQUIRE(by_face.triangle_colors.size() == 2);
  CHECK(by_face.triangle_colors[0] == Eigen::Vector3f(1, 0, 0));
  CHECK(by_face.triangle_colors[1] == Eigen::Vector3f(0, 0, 1));
  const Appearance by_vertex =
      read_ply_text(head + color + faces +
                    "end_header\n0 0 0 0 255 0\n1 0 0 0 255 0\n0 1 0 0 255 0\n0 0 1 0 "
                    "255 0\n3 0 1 2\n3 0 2 3\n")
          .appearance;
  CHECK(by_vertex.given);
  CHECK(by_vertex.color == Eigen::Vector3f(0, 1, 0));
}

TEST_CASE("what is wrong in the header of a PLY file is told by line") {
  const auto refused = [](const std::string& lines, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_ply_text(lines), ("q.ply" + sentence).c_str(), Error);
  };
  refused("plus\n", ":1: expected 'ply' in the first line");
  refused("ply\nformat text 1.0\n",
          ":2: expected ascii, binary_little_endian or binary_big_endian, got 'text'");
  refused("ply\nelement vertex many\n",
          ":2: number of elements 'vertex': expected a whole number, got 'many'");
  refused("ply\nelement vertex -1\n",
          ":2: number of elements 'vertex': expected a whole number from 0 on, got -1");
  refused("ply\nproperty float x\n", ":2: expected an element before its properties");
  refused("ply\nelement vertex 1\nproperty real x\n",
          ":3: expected a type of PLY such as float or uchar, got 'real'");
  refused("ply\nelement face 1\nproperty list float int i\n",
          ":3: expected a whole type for the count of a list");
  refused("ply\nelement face 1\nproperty float\n",
          ":3: expected the name of a property, got nothing");
  refused("ply\nelem face 1\n", ":2: expected a line of a PLY header, got 'elem'");
  refused("ply\nend_header\n", ":2: expected a line 'format' before end_header");
  refused("ply\nformat ascii 1.0\n", ":2: expected end_header, got the end of the file");
  refused("ply\nformat ascii 1.0\n" + faces + vertex_lines + "end_header\n",
          ": expected the vertices before the faces");
  refused(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 "
      "0\n",
      ": expected x, y and z of every vertex, got none of 'z'");
  refused("ply\nformat ascii 1.0\n" + vertex_lines + vertex_lines + "end_header\n" + point_rows,
          ": expected one element vertex, got two");
  refused("ply\nformat ascii 1.0\n" + vertex_lines +
              "element face 1\nproperty int a\nend_header\n" + point_rows,
          ": expected a list vertex_indices of every face, got none");
}

TEST_CASE("what is wrong in the lines of a PLY file is told by line") {
  const std::string head = "ply\nformat ascii 1.0\n" + vertex_lines + faces + "end_header\n";
  const auto refused = [&](const std::string& rows, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_ply_text(head + rows), ("q.ply:" + sentence).c_str(), Error);
  };
  refused("0 0 0\n1 0 x\n", "11: expected a number, got 'x'");
  refused("0 0 0\n1 0 nan\n", "11: expected a number, got 'nan'");
  refused("0 0 0\n1 0\n", "11: expected a number, got nothing");
  refused("0 0 0\n", "10: expected vertex 2 of 4, got the end of the file");
  refused(point_rows + "3 0 1 4\n", "14: expected a vertex from 0 to 3, got 4");
  refused(point_rows + "3 0 1 -1\n", "14: expected a vertex from 0 on, got -1");
  refused(point_rows + "3 0 1 0.5\n", "14: expected a whole number, got 0.5");
  refused(point_rows + "-3 0 1 2\n", "14: expected a count of vertex_index from 0 on, got -3");
  refused(point_rows + "4e9 0 1 2\n",
          "14: expected a count of vertex_index up to 1073741824, got 4000000000");
  Warnings warnings;
  read_ply_text("ply\nformat ascii 1.0\n" + vertex_lines + faces +
                    "element edge 1\nproperty int a\nend_header\n" + point_rows +
                    "3 0 1 2 9\n3 0 1 3\n5\nmore\n",
                warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"q.ply: its elements 'edge' are not used",
                                 "q.ply:16: text after the values of a face is not used"});
}

TEST_CASE("what is wrong in the bytes of a PLY file is told by element") {
  const Mesh mesh = box(1, 1, 1);
  const std::string content = binary_ply(mesh, false);
  const size_t body = content.find("end_header\n") + 11;
  const auto refused = [&](const std::string& bytes, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_ply_text(bytes), ("q.ply: " + sentence).c_str(), Error);
  };
  refused(content.substr(0, body + 20 * 3 + 5),
          "vertex 4 of 8: expected 8 bytes, got the end of the file");
  refused(content.substr(0, body + 20 * 8 + 14 * 2 + 1),
          "face 3 of 12: expected 1 bytes, got the end of the file");
  std::string bad = content, nan;
  append_bytes(nan, std::numeric_limits<float>::infinity());
  bad.replace(body + 20, 4, nan);
  refused(bad, "vertex 2 of 8: expected finite coordinates, got inf");
  bad = content;
  bad[body + 20 * 8 + 14 + 2] = 8;
  refused(bad, "face 2 of 12: expected a vertex from 0 to 7, got 8");
  Warnings warnings;
  read_ply_text(content + "more", warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"q.ply: 4 bytes after the last element are not used"});
}
