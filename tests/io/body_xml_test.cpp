#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

/// A box of 2 x 4 x 6 mm about the origin, in three formats.
static void write_boxes(const TemporaryFolder& folder) {
  folder.write("box.iv", "#Inventor V2.1 ascii\n#mass 7\nCube { width 2 height 4 depth 6 }\n");
  std::string corners, ply_corners;
  for (int i = 0; i < 8; ++i)
    corners += fmt::format("{} {} {}\n", i & 1 ? 1 : -1, i & 2 ? 2 : -2, i & 4 ? 3 : -3);
  const char* faces = "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  folder.write("box.off", "OFF\n8 6 0\n" + corners + faces);
  folder.write("box.ply",
               "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double "
               "y\nproperty double z\nelement face 6\nproperty list uchar int "
               "vertex_indices\nend_header\n" +
                   corners + faces);
}

static BodySpec read_xml_body(const std::string& inside, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  write_boxes(folder);
  return read_body(folder.write("body.xml", "<root>\n" + inside + "</root>\n"), options);
}

static Eigen::Vector3d size(const BodySpec& body) {
  return body.shape->bounds().high - body.shape->bounds().low;
}

TEST_CASE("every element of a body is read in SI") {
  const BodySpec body = read_xml_body(
      "<material>rubber</material><youngs>1500000</youngs><mass>178.5</mass><cog>0 40.1 "
      "-2</cog><inertia_matrix>1043 0 1 0 611 0 1 0 "
      "1043</inertia_matrix><useFlockOfBirds>2.0</useFlockOfBirds><geometryFile "
      "type=\"Inventor\">box.iv</geometryFile>\n");
  CHECK(body.name == "body");
  CHECK(body.material == "rubber");
  CHECK(*body.elastic_modulus == 1.5e6);
  CHECK(body.mass == doctest::Approx(0.1785));
  CHECK((*body.com - Eigen::Vector3d(0, 0.0401, -0.002)).norm() < 1e-15);
  CHECK((*body.inertia_per_mass)(0, 0) == doctest::Approx(1043e-6));
  CHECK((*body.inertia_per_mass)(0, 2) == doctest::Approx(1e-6));
  CHECK(*body.tracker == 2);
  // Coin's coordinates have 24 bits
  CHECK((size(body) - Eigen::Vector3d(0.002, 0.004, 0.006)).norm() < 1e-9);
  CHECK(body.file.ends_with("/body.xml"));
  CHECK(body.file.front() == '/');
}

TEST_CASE("the geometry's own '#' lines do not count, for the XML is the body") {
  const BodySpec body = read_xml_body("<geometryFile>box.iv</geometryFile>\n");
  CHECK(body.mass == 0.3);
  CHECK(body.material == "wood");
  CHECK_FALSE(body.com);
  CHECK_FALSE(body.inertia_per_mass);
}

TEST_CASE("OFF and PLY count as millimeters, whatever their size") {
  for (const std::string format : {"off", "ply"}) {
    const BodySpec body =
        read_xml_body("<geometryFile type=\"" + format + "\">box." + format + "</geometryFile>\n");
    CHECK((size(body) - Eigen::Vector3d(0.002, 0.004, 0.006)).norm() < 1e-15);
    CHECK(body.shape->closed());
  }
}

TEST_CASE("the type tells how geometry is written whose ending says nothing") {
  const TemporaryFolder folder;
  const std::string off =
      "OFF\n4 4 6\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  folder.write("c.mesh", off);
  folder.write("b.mesh", "#Inventor V2.1 ascii\nCube { }");
  const auto read_xml_body = [&](const std::string& element) {
    return read_body(folder.write("a.xml", "<root>\n" + element + "\n</root>"));
  };
  CHECK(read_xml_body("<geometryFile type='off'>c.mesh</geometryFile>")
            .shape->mesh()
            .triangles.size() == 4);
  CHECK(read_xml_body("<geometryFile type='OFF'>c.mesh</geometryFile>").shape->bounds().high.x() ==
        doctest::Approx(0.009));
  CHECK(read_xml_body("<geometryFile type='Inventor'>b.mesh</geometryFile>")
            .shape->mesh()
            .triangles.size() == 12);
  CHECK_THROWS_WITH_AS(
      read_xml_body("<geometryFile type='of'>c.mesh</geometryFile>"),
      "a.xml:2: geometryFile: expected type Inventor, off, ply or that of another mesh, got 'of'",
      Error);
  CHECK_THROWS_AS(read_xml_body("<geometryFile>c.mesh</geometryFile>"), Error);
}

TEST_CASE("geometry is scaled first, then moved by an offset that is not") {
  for (const std::string file : {"box.iv", "box.off"}) {
    const BodySpec body = read_xml_body(
        "<geometryFile>" + file +
        "</geometryFile><geometryScaling>10</geometryScaling><geometryOffset><transform>"
        "<translation>100 0 0</translation><rotation>90 z</rotation></transform>"
        "</geometryOffset>\n");
    // the rotation about z exchanges x and y
    CHECK((size(body) - Eigen::Vector3d(0.04, 0.02, 0.06)).norm() < 1e-8);
    const Eigen::Vector3d middle = 0.5 * (body.shape->bounds().high + body.shape->bounds().low);
    CHECK((middle - Eigen::Vector3d(0.1, 0, 0)).norm() < 1e-8);
  }
}

TEST_CASE("factors along x, y and z apply alone or together") {
  const std::string file = "<geometryFile>box.off</geometryFile>";
  const BodySpec three =
      read_xml_body(file +
                    "<geometryScalingX>2</geometryScalingX><geometryScalingY>3</"
                    "geometryScalingY><geometryScalingZ>0.5</geometryScalingZ>\n");
  CHECK((size(three) - Eigen::Vector3d(0.004, 0.012, 0.003)).norm() < 1e-15);
  const BodySpec one = read_xml_body(file + "<geometryScalingY>3</geometryScalingY>\n");
  CHECK((size(one) - Eigen::Vector3d(0.002, 0.012, 0.006)).norm() < 1e-15);
}

TEST_CASE("meters scaled by 1000 keep every digit") {
  const TemporaryFolder folder;
  folder.write(
      "a.off",
      "OFF\n4 4 0\n0.1 0.7 0.3\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const BodySpec body = read_body(folder.write(
      "a.xml",
      "<root><geometryFile>a.off</geometryFile><geometryScaling>1000</geometryScaling></root>"));
  const auto& v = body.shape->mesh().vertices;
  CHECK(std::count(v.begin(), v.end(), Eigen::Vector3d(0.1, 0.7, 0.3)) == 1);
}

TEST_CASE("a body without geometry is a frame, with a warning") {
  Warnings warnings;
  const BodySpec body = read_xml_body("<mass>10</mass>\n", warnings.options());
  CHECK_FALSE(body.shape);
  CHECK(body.mass == doctest::Approx(0.01));
  CHECK(warnings.list ==
        std::vector<std::string>{
            "body.xml:1: no <geometryFile>: the body is a frame without a surface"});
}

TEST_CASE(
    "a body whose geometry has no surface is a frame, which is told with the line that names it") {
  TemporaryFolder folder;
  folder.write("none.iv", "#Inventor V2.1 ascii\nSeparator { }\n");
  Warnings warnings;
  const auto file = folder.write(
      "body.xml", "<root>\n<mass>10</mass>\n<geometryFile>none.iv</geometryFile>\n</root>");
  CHECK_FALSE(read_body(file, warnings.options()).shape);
  CHECK(warnings.list ==
        std::vector<std::string>{
            "body.xml:3: no surface in 'none.iv': the body is a frame, which touches nothing"});
}

TEST_CASE("what a body's file holds and is not used is warned of") {
  Warnings warnings;
  read_xml_body(
      "<geometryFile type=\"ply\">box.off</geometryFile>\n<normalCompliance>1</"
      "normalCompliance><shearCompliance>1</shearCompliance>\n<youngs>1.5</youngs>\n<color/>\n"
      "<inertia_matrix>1 2 0 0 1 0 0 0 1</inertia_matrix>\n",
      warnings.options());
  const std::vector<std::string> expected = {
      "body.xml:5: unknown element <color> in <root> is not used",
      "body.xml:4: youngs 1.5 Pa is softer than any rubber; is it meant in MPa?",
      "body.xml:3: normalCompliance and shearCompliance are not used",
      "body.xml:6: inertia_matrix is not symmetric; its symmetric part is used",
      "body.xml:6: inertia_matrix is not positive definite; it is computed from the shape",
      "body.xml:2: geometryFile: type 'ply' does not fit 'box.off'; the ending of the file is "
      "used"};
  CHECK(warnings.list == expected);
}
