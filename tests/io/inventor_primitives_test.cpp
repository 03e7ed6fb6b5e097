#include "clench/io/graspit/inventor_primitives.h"

#include <numbers>

#include "clench/base/error.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;
using Eigen::Vector3d;

// scene graphs have single precision
static constexpr double single = 1e-6;

static std::vector<Primitive> read_inventor(const std::string& body,
                                            const ReadOptions& options = {}) {
  TemporaryFolder folder;
  return read_primitives(folder.write("a.iv", "#Inventor V2.1 ascii\n" + body), options);
}

TEST_CASE("each kind of primitive comes with its sizes in meters and its pose") {
  const auto list = read_inventor(R"(
Separator { Translation { translation 10 20 30 } Cube { width 20 height 30 depth 40 } }
Separator { RotationXYZ { axis X angle 1.5707963 } Cylinder { radius 5 height 50 } }
Sphere { radius 7 }
Cone { bottomRadius 3 height 9 })");
  REQUIRE(list.size() == 4);
  CHECK(list[0].kind == PrimitiveKind::box);
  CHECK((list[0].size - Vector3d(0.02, 0.03, 0.04)).norm() < single);
  CHECK((list[0].X_OP.position - Vector3d(0.01, 0.02, 0.03)).norm() < single);
  CHECK(list[1].kind == PrimitiveKind::cylinder);
  CHECK(list[1].radius == doctest::Approx(0.005));
  CHECK(list[1].height == doctest::Approx(0.05));
  // its axis, y, is along z
  CHECK((list[1].X_OP.rotation * Vector3d::UnitY() - Vector3d::UnitZ()).norm() < single);
  CHECK(list[2].radius == doctest::Approx(0.007));
  CHECK(list[3].kind == PrimitiveKind::cone);
  CHECK(list[3].height == doctest::Approx(0.009));
}

TEST_CASE("VRML says the same") {
  TemporaryFolder folder;
  const auto list = read_primitives(folder.write(
      "a.wrl",
      "#VRML V2.0 utf8\nTransform { translation 0 0 5 children [ Shape { geometry Box { size 2 4 6 "
      "} "
      "} Shape { geometry Cylinder { radius 1 height 3 } } Shape { geometry Sphere { radius 2 } } "
      "Shape { geometry Cone { bottomRadius 2 height 8 } } ] }"));
  REQUIRE(list.size() == 4);
  CHECK((list[0].size - Vector3d(0.002, 0.004, 0.006)).norm() < single);
  for (const auto& p : list) CHECK(p.X_OP.position.z() == doctest::Approx(0.005));
}

TEST_CASE("scales go into the sizes, mirrored ones too") {
  const auto list = read_inventor(
      "Scale { scaleFactor -2 3 4 } Cube { width 1 height 1 depth 1 }\n"
      "Separator { Scale { scaleFactor 2 1 1 } Cylinder { radius 1 height 2 } }");
  CHECK((list[0].size - Vector3d(0.002, 0.003, 0.004)).norm() < single);
  CHECK(list[0].X_OP.matrix().determinant() == doctest::Approx(1));
  CHECK(list[1].radius == doctest::Approx(0.004));
  CHECK(list[1].height == doctest::Approx(0.006));
}

TEST_CASE("what is no primitive, and what is oval, are warnings") {
  Warnings warnings;
  read_inventor(
      "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] } IndexedFaceSet { coordIndex [0,1,2] } Scale { "
      "scaleFactor 2 1 1 } Sphere { }",
      warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"a.iv: IndexedFaceSet is no primitive and is not used",
                                 "a.iv: sphere: it is oval; the largest radius is used"});
}

TEST_CASE("of an object's file the primitives beside it are read, if there are some") {
  TemporaryFolder folder;
  const std::string head = "#Inventor V2.1 ascii\n";
  const auto object = folder.write("mug.iv", head + "Cube { }");
  CHECK(read_primitives(object)[0].kind == PrimitiveKind::box);
  folder.write("primitives/mug.iv", head + "Sphere { }");
  CHECK(read_primitives(object)[0].kind == PrimitiveKind::sphere);
}

TEST_CASE("of an XML body the geometry's primitives are read, scaled and placed as it says") {
  TemporaryFolder folder;
  const std::string head = "#Inventor V2.1 ascii\n";
  folder.write("shape.iv",
               head + "Translation { translation 10 0 0 } Cube { width 2 height 4 depth 6 }");
  const auto read_inventor = [&](const std::string& rest, const ReadOptions& options = {}) {
    return read_primitives(folder.write("mug.xml", "<root>\n" + rest + "</root>"), options);
  };
  const std::string file = "<geometryFile type='Inventor'>shape.iv</geometryFile>";
  const auto list =
      read_inventor(file +
                    "<geometryScaling>2</geometryScaling><geometryOffset><transform>"
                    "<translation>0 0 5</translation><rotation>90 z</rotation></transform>"
                    "</geometryOffset>");
  REQUIRE(list.size() == 1);
  CHECK((list[0].size - Vector3d(0.004, 0.008, 0.012)).norm() < single);
  // 20 mm along x, which a quarter turn brings to y
  CHECK((list[0].X_OP.position - Vector3d(0, 0.02, 0.005)).norm() < single);
  CHECK((list[0].X_OP.rotation * Vector3d::UnitX() - Vector3d::UnitY()).norm() < single);
  CHECK((read_inventor(file + "<geometryScalingZ>3</geometryScalingZ>")[0].size -
         Vector3d(0.002, 0.004, 0.018))
            .norm() < single);

  // if the ending is unknown, the attribute `type` determines the format
  folder.write("shape.dat", head + "Sphere { }");
  CHECK(read_inventor("<geometryFile type='Inventor'>shape.dat</geometryFile>").size() == 1);
  CHECK_THROWS_WITH_AS(read_inventor("<geometryFile>shape.off</geometryFile>"),
                       "mug.xml:2: no such file: shape.off; did you mean 'shape.dat'?", Error);
  folder.write("shape.off", "OFF\n");
  CHECK_THROWS_WITH_AS(read_inventor("<geometryFile>shape.off</geometryFile>"),
                       "shape.off: expected primitives from .iv, .wrl or .vrml, got '.off'", Error);
  Warnings warnings;
  CHECK(read_inventor("<mass>3</mass>", warnings.options()).empty());
  CHECK(warnings.list == std::vector<std::string>{"mug.xml:1: no <geometryFile>: no primitives"});
  CHECK_THROWS_WITH_AS(read_primitives(folder.write("hand.xml", "<robot/>")),
                       "hand.xml:1: expected a body, got <robot>", Error);

  // the simplified file is preferred, and is in the body's frame
  folder.write("primitives/mug.iv", head + "Cone { }");
  CHECK(read_inventor(file + "<geometryScaling>2</geometryScaling>")[0].kind ==
        PrimitiveKind::cone);
}

TEST_CASE("the primitives of the original's objects load") {
  REQUIRE_SHARED();
  const auto folder = test::shared() / "data/graspit/models/objects";
  const auto mug = read_primitives(folder / "mug.iv");
  REQUIRE(mug.size() == 2);
  CHECK(mug[0].kind == PrimitiveKind::cylinder);
  CHECK(mug[0].radius == doctest::Approx(0.05));
  CHECK((mug[0].X_OP.position - Vector3d(0.003, -0.01, 0)).norm() < single);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "primitives")) {
    INFO(entry.path().string());
    CHECK(read_primitives(entry.path()).size() >= 1);
    ++files;
  }
  CHECK(files == 10);
  CHECK(read_primitives(folder / "p51.iv").size() == 3);
}
