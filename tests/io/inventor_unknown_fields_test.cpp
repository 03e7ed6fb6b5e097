// Fields that a node type does not have, and features of Inventor 1 files.
#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

namespace {

struct Read {
  BodySpec body;
  std::vector<std::string> warnings;
};

Read read_nodes_of(const std::string& nodes, const std::string& header = "#Inventor V2.1 ascii") {
  const TemporaryFolder folder;
  Warnings warnings;
  Read out;
  out.body = read_body(folder.write("a.iv", header + "\n" + nodes), warnings.options());
  out.warnings = warnings.list;
  return out;
}

std::vector<Eigen::Vector3d> corners_of(const BodySpec& body) {
  std::vector<Eigen::Vector3d> out;
  const Mesh& mesh = body.shape->mesh();
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) out.push_back(mesh.vertices[t[k]]);
  return out;
}

}  // namespace

TEST_CASE("an unknown field is skipped with its value of any kind") {
  const char* values[] = {"3",
                          "-1.5e3 +2 .5",
                          "1 2, 3",
                          "0xFF",
                          "\"a } string\"",
                          "TRUE",
                          "WORD",
                          "(SIDES | TOP)",
                          "(SIDES)",
                          "[ ]",
                          "[ 1 2 3, \"]\" ]",
                          "[ Cube { width 5 }, DEF a Cube { } ]",
                          "Cube { width 90 }",
                          "DEF b Cube { width 90 }",
                          "USE other",
                          "NULL",
                          "= USE other.width",
                          "3 = Engine { }.out",
                          "~",
                          "IS width"};
  // each is placed before a field, between two, at the end of a node, and before a child
  const std::string before = "DEF other Group { }\nSeparator { ", after = "}";
  const std::string places[] = {
      "ShapeHints { # faceType CONVEX }\nCube { width 10 height 20 depth 30 }",
      "Cube { # width 10 height 20 depth 30 }",
      "Cube { width 10 # height 20 depth 30 }",
      "Cube { width 10 height 20 depth 30 # }",
      "Material { # diffuseColor 1 0 0 }\nCube { width 10 height 20 depth 30 }",
      "# Cube { width 10 height 20 depth 30 }",
      "Cube { width 10 height 20 depth 30 }\n#"};
  const auto expected = corners_of(read_nodes_of("Cube { width 10 height 20 depth 30 }").body);
  for (const std::string& place : places)
    for (const std::string value : values) {
      const size_t at = place.find('#');
      const std::string nodes = before + place.substr(0, at) + "hints_of_mine " + value +
                                (value == "~" ? " " : " ") + place.substr(at + 1) + after;
      CAPTURE(nodes);
      const Read read = read_nodes_of(nodes);
      CHECK(corners_of(read.body) == expected);
      REQUIRE(read.warnings.size() == 1);
      CHECK(read.warnings[0].find(": unknown field 'hints_of_mine' is skipped") !=
            std::string::npos);
    }
}

TEST_CASE("a name before braces is an unknown field in a node without children, else a node") {
  CHECK(read_nodes_of("Material { foo { 1 { 2 } } }\nCube { bar { 1 { 2 } } }").warnings ==
        std::vector<std::string>{"a.iv:2: Material: unknown field 'foo' is skipped",
                                 "a.iv:3: unknown node 'bar' is skipped"});
}

TEST_CASE("each of several unknown fields is named, with a suggestion") {
  const Read read = read_nodes_of("Cube { widht 3 foo 1 2 bar BAZ\n qux [ 1 ] }");
  CHECK(read.warnings ==
        std::vector<std::string>{
            "a.iv:2: Cube: unknown field 'widht' is skipped; did you mean 'width'?",
            "a.iv:2: Cube: unknown field 'foo' is skipped",
            "a.iv:2: Cube: unknown field 'bar' is skipped",
            "a.iv:3: Cube: unknown field 'qux' is skipped"});
  CHECK(read.body.shape->bounds().size().x() == doctest::Approx(0.002));
}

TEST_CASE("an unknown field without a value, or an invalid name, is rejected") {
  const auto refused = [](const std::string& nodes, const std::string& sentence) {
    CHECK_THROWS_WITH_AS(read_nodes_of(nodes), sentence.c_str(), Error);
  };
  refused("Cube { wdith }", "a.iv:2: Cube: unknown field 'wdith'; did you mean 'width'?");
  refused("Cube { 5 }", "a.iv:2: Cube: unknown field '5'");
  refused("Cube { .b 5 }", "a.iv:2: Cube: unknown field '.b'");
  refused("Cube { foo DEF }", "a.iv:2: expected a name after DEF, got '}'");
  refused("Cube { foo (A | B }", "a.iv:2: expected a word or ')', got '}'");
  refused("Cube { foo [ 1 }", "a.iv:2: expected ']' for the '[' of line 2, got '}'");
  refused("Cube { foo DEF a B }", "a.iv:2: expected '{' after the node type, got '}'");
}

TEST_CASE("a strict reader refuses an unknown field") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(
      read_body(folder.write("a.iv", "#Inventor V2.1 ascii\nCube { foo 1 }"), strict({})),
      "a.iv:2: Cube: unknown field 'foo' is skipped", Error);
}

TEST_CASE("hints of Inventor 1 say whether faces are convex") {
  // a concave face, for which a triangle fan would cover too much
  const std::string face =
      "Coordinate3 { point [ 0 0 0, 10 0 0, 10 10 0, 8 2 0 ] } IndexedFaceSet { coordIndex [ 0, 1, "
      "2, 3, -1 ] }";
  const auto area = [&](const std::string& hints) {
    const Read read = read_nodes_of("ShapeHints { " + hints + " } " + face, "#Inventor V1.0 ascii");
    CHECK(read.warnings.empty());
    double sum = 0;
    const auto p = corners_of(read.body);
    for (size_t i = 0; i + 2 < p.size(); i += 3)
      sum += 0.5e6 * (p[i + 1] - p[i]).cross(p[i + 2] - p[i]).norm();
    return sum;
  };
  const double concave = area("faceType UNKNOWN_FACE_TYPE"), fan = area("");
  CHECK(concave != doctest::Approx(fan));
  for (const char* hints : {"hints NONE", "hints (SOLID | ORDERED)", "hints SOLID creaseAngle 0.5",
                            "hints (SURFACE|UNORDERED|CONCAVE)"})
    CHECK(area(hints) == doctest::Approx(concave));
  for (const char* hints : {"hints (SOLID | ORDERED | CONVEX)", "hints CONVEX",
                            "hints    (SOLID | ORDERED | CONVEX)\n"})
    CHECK(area(hints) == doctest::Approx(fan));
}

TEST_CASE("groups and strips of Inventor 1 are read") {
  const std::string header = "#Inventor V1.0 ascii";
  CHECK(read_nodes_of("LayerGroup { Cube { } }", header).body.shape->mesh().triangles.size() == 12);
  const std::string points =
      "Coordinate3 { point [ 0 0 0, 10 0 0, 10 10 0, 0 10 0, 20 5 0 ] } IndexedTriangleMesh { "
      "coordIndex [ ";
  // without a swap it is a strip; with one the last two corners are exchanged, which gives a fan
  // about corner 0
  const auto strip = corners_of(read_nodes_of(points + "0, 1, 3, 2, -1 ] }", header).body);
  CHECK(strip == corners_of(read_nodes_of("Coordinate3 { point [ 0 0 0, 10 0 0, 10 10 0, 0 10 0 ] "
                                          "} IndexedTriangleStripSet { coordIndex [ 0, 1, 3, 2, "
                                          "-1 ] }")
                                .body));
  const Read fan = read_nodes_of(points + "1, 0, -2, 2, -2, 3, -1 ] }", header);
  CHECK(fan.warnings.empty());
  CHECK(fan.body.shape->mesh().triangles.size() == 2);
  for (const auto& n : corners_of(fan.body)) CHECK(n.x() < 0.011);
}
