#include <chrono>
#include <cmath>

#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "support/listening.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

static BodySpec body(const std::string& nodes, const std::string& header = "#Inventor V2.1 ascii") {
  const TemporaryFolder folder;
  return read_body(folder.write("body.iv", header + "\n" + nodes));
}

static BodySpec vrml(const std::string& nodes) { return body(nodes, "#VRML V2.0 utf8"); }

static void check_box(const BodySpec& b, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  REQUIRE(b.shape);
  // 32-bit coordinates of the reader
  CHECK((b.shape->bounds().low - low).cwiseAbs().maxCoeff() < 1e-8);
  CHECK((b.shape->bounds().high - high).cwiseAbs().maxCoeff() < 1e-8);
}

static const std::string square = "Coordinate3 { point [ 0 0 0, 10 0 0, 10 10 0, 0 10 0 ] }\n";

TEST_CASE("a cube is a closed box of 12 triangles, in millimeters, facing outward") {
  const BodySpec b = body("Cube { width 10 height 20 depth 30 }");
  CHECK(b.name == "body");
  CHECK(b.shape->mesh().triangles.size() == 12);
  CHECK(b.shape->mesh().vertices.size() == 8);
  CHECK(b.shape->faults().none());
  CHECK(b.shape->solid().volume == doctest::Approx(0.01 * 0.02 * 0.03));
  check_box(b, {-0.005, -0.01, -0.015}, {0.005, 0.01, 0.015});
}

TEST_CASE("round shapes are closed and as large as they say") {
  for (const auto* shape : {"Sphere { radius 10 }", "Cylinder { radius 10 height 20 }",
                            "Cone { bottomRadius 10 height 20 }"}) {
    INFO(shape);
    const BodySpec b = body(shape);
    CHECK(b.shape->closed());
    CHECK(b.shape->solid().volume > 0);
    CHECK(b.shape->bounds().size().y() == doctest::Approx(0.02));
    CHECK(b.shape->bounds().size().maxCoeff() <= 0.02 * (1 + 1e-6));
  }
  const double pi = 3.14159265358979;
  // polyhedra inscribed in the round ones: smaller, by less than a tenth
  CHECK(body("Sphere { radius 10 }").shape->solid().volume ==
        doctest::Approx(4 * pi / 3 * 1e-6).epsilon(0.1));
  CHECK(body("Cylinder { radius 10 height 20 }").shape->solid().volume ==
        doctest::Approx(2 * pi * 1e-6).epsilon(0.1));
  CHECK(body("Cone { bottomRadius 10 height 20 }").shape->solid().volume ==
        doctest::Approx(2 * pi / 3 * 1e-6).epsilon(0.1));
}

TEST_CASE("transforms act in their order, within their separator") {
  check_box(body("Separator { Translation { translation 100 0 0 } Separator { RotationXYZ { axis Z "
                 "angle 1.5707963 } "
                 "Scale { scaleFactor 2 1 1 } Cube { width 10 height 20 depth 30 } } }"),
            {0.09, -0.01, -0.015}, {0.11, 0.01, 0.015});
  check_box(body("Separator { Separator { Translation { translation 100 0 0 } } Cube { width 10 "
                 "height 10 depth 10 } }"),
            {-0.005, -0.005, -0.005}, {0.005, 0.005, 0.005});
  check_box(body("Separator { Group { Translation { translation 100 0 0 } } Cube { width 10 height "
                 "10 depth 10 } }"),
            {0.095, -0.005, -0.005}, {0.105, 0.005, 0.005});
  check_box(body("Separator { MatrixTransform { matrix 1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1 } Cube { "
                 "width 2 height 2 depth 2 } }"),
            {0.004, 0.005, 0.006}, {0.006, 0.007, 0.008});
  check_box(body("Separator { Transform { translation 1 2 3 scaleFactor 2 2 2 center 1 0 0 } Cube "
                 "{ width 2 height 2 depth 2 } }"),
            {-0.002, 0, 0.001}, {0.002, 0.004, 0.005});
  check_box(body("Separator { SoScale { scaleFactor 3 3 3 } Cube { width 2 height 2 depth 2 } }"),
            {-0.003, -0.003, -0.003}, {0.003, 0.003, 0.003});
  check_box(body("Separator { Units { units CENTIMETERS } Cube { width 2 height 2 depth 2 } }",
                 "#Inventor V1.0 ascii"),
            Eigen::Vector3d::Constant(-1e-5), Eigen::Vector3d::Constant(1e-5));
}

TEST_CASE("a mirrored shape faces outward all the same") {
  const BodySpec b =
      body("Separator { Scale { scaleFactor -1 1 1 } Cube { width 10 height 10 depth 10 } }");
  CHECK(b.shape->solid().volume == doctest::Approx(1e-6));
}

TEST_CASE("faces listed clockwise are turned") {
  const std::string face = "IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] } }";
  const auto normal_z = [&](const std::string& hints) {
    const auto c = body("Separator { " + hints + square + face).shape->mesh().corners(0);
    return (c[1] - c[0]).cross(c[2] - c[0]).z();
  };
  CHECK(normal_z("") > 0);
  CHECK(normal_z("ShapeHints { vertexOrdering COUNTERCLOCKWISE }") > 0);
  CHECK(normal_z("ShapeHints { vertexOrdering CLOCKWISE }") < 0);
}

TEST_CASE("a closed mesh that is inside out is turned, with a warning") {
  const TemporaryFolder folder;
  Warnings warnings;
  const auto file = folder.write(
      "tetra.iv",
      "#Inventor V2.1 ascii\nSeparator { Coordinate3 { point [ 0 0 0, 10 0 0, 0 10 0, 0 0 10 ] }\n"
      "IndexedFaceSet { coordIndex [ 0,1,2,-1, 0,2,3,-1, 0,3,1,-1, 1,3,2 ] } }");
  const BodySpec b = read_body(file, warnings.options());
  CHECK(b.shape->solid().volume == doctest::Approx(1e-6 / 6));
  REQUIRE(warnings.list.size() == 1);
  CHECK(warnings.list[0] == "tetra.iv: its triangles face inward; flipped to face outward");
}

TEST_CASE("polygons, strips and meshes of points become triangles that cover the same area") {
  const auto area = [](const std::string& nodes) {
    return body("Separator { " + nodes + " }").shape->mesh().area();
  };
  CHECK(area(square + "IndexedFaceSet { coordIndex [ 0, 1, 2, 3 ] }") == doctest::Approx(1e-4));
  CHECK(area(square + "IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ] }") ==
        doctest::Approx(1e-4));
  CHECK(area(square + "FaceSet { numVertices -1 }") == doctest::Approx(1e-4));
  CHECK(area(square + "FaceSet { startIndex 1 numVertices 3 }") == doctest::Approx(0.5e-4));
  CHECK(area(square + "IndexedTriangleStripSet { coordIndex [ 0, 1, 3, 2, -1 ] }") ==
        doctest::Approx(1e-4));
  CHECK(area("Coordinate3 { point [ 0 0 0, 10 0 0, 0 10 0, 10 10 0 ] } TriangleStripSet { "
             "numVertices 4 }") == doctest::Approx(1e-4));
  CHECK(area("Coordinate3 { point [ 0 0 0, 10 0 0, 0 10 0, 10 10 0 ] } QuadMesh { verticesPerRow 2 "
             "verticesPerColumn 2 }") == doctest::Approx(1e-4));
  CHECK(area("FaceSet { vertexProperty VertexProperty { vertex [ 0 0 0, 10 0 0, 10 10 0 ] } }") ==
        doctest::Approx(0.5e-4));
  CHECK(area("Coordinate4 { point [ 0 0 0 1, 20 0 0 2, 10 10 0 1 ] } FaceSet { }") ==
        doctest::Approx(0.5e-4));
}

TEST_CASE("the triangles of a strip all turn the same way") {
  const Mesh mesh =
      body("Separator { " + square + "IndexedTriangleStripSet { coordIndex [ 0, 1, 3, 2 ] } }")
          .shape->mesh();
  for (int t = 0; t < 2; ++t) {
    const auto c = mesh.corners(t);
    CHECK((c[1] - c[0]).cross(c[2] - c[0]).z() > 0);
  }
}

TEST_CASE("an L-shaped face is not filled in, unless the file says it is convex") {
  const std::string points =
      "Coordinate3 { point [ 0 0 0, 20 0 0, 20 10 0, 10 10 0, 10 20 0, 0 20 0 ] }\n";
  const std::string face = "IndexedFaceSet { coordIndex [ 1, 2, 3, 4, 5, 0 ] } }";
  CHECK(body("Separator { " + points + face).shape->mesh().area() == doctest::Approx(3e-4));
  CHECK(body("Separator { ShapeHints { faceType CONVEX }" + points + face).shape->mesh().area() >
        3.5e-4);
}

TEST_CASE("triangles with two equal corners are dropped") {
  const BodySpec b =
      body("Separator { " + square +
           "IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 0, 1, -1, 2, 3, 2, -1 ] } }");
  CHECK(b.shape->mesh().triangles.size() == 1);
}

TEST_CASE("VRML 2 shapes stand in their transforms") {
  const BodySpec b = vrml(
      "Transform { translation 10 0 0 scale 2 1 1 rotation 0 0 1 1.5707963 children [\n"
      "  Shape { geometry Box { size 10 20 30 } } ] }");
  check_box(b, {0, -0.01, -0.015}, {0.02, 0.01, 0.015});
  CHECK(vrml("Shape { geometry Sphere { radius 3 } }").shape->closed());
  CHECK(vrml("Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 "
             "1 0 ] } coordIndex [ 0 1 2 3 -1 ] } }")
            .shape->mesh()
            .area() == doctest::Approx(1e-6));
  CHECK(
      vrml("Shape { geometry ElevationGrid { xDimension 3 zDimension 2 height [ 0 0 0 0 0 0 ] } }")
          .shape->mesh()
          .area() == doctest::Approx(2e-6));
  CHECK(vrml("PROTO Ball [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } }\nBall "
             "{ r 5 }")
            .shape->bounds()
            .size()
            .y() == doctest::Approx(0.01));
}

TEST_CASE("a switch shows the child that it names") {
  CHECK(body("Switch { whichChild 1 Cube { width 1 } Cube { width 7 } }")
            .shape->bounds()
            .size()
            .x() == doctest::Approx(0.007));
  CHECK_FALSE(body("Switch { Cube { } }").shape);
  CHECK(body("Switch { whichChild -3 Cube { width 1 } Cube { width 7 } }")
            .shape->mesh()
            .triangles.size() == 24);
}

TEST_CASE("a shared node stands at each place where it is used") {
  const BodySpec b = body(
      "Separator { DEF part+0 Cube { width 2 height 2 depth 2 } Translation { translation 10 0 0 } "
      "USE part+0 }");
  CHECK(b.shape->mesh().triangles.size() == 24);
  CHECK(b.shape->bounds().size().x() == doctest::Approx(0.012));
}

TEST_CASE("lines, points and text have no triangles") {
  CHECK_FALSE(body("Separator { " + square +
                   "IndexedLineSet { coordIndex [ 0, 1, -1 ] } LineSet { } PointSet { } "
                   "Text2 { string \"a\" } Text3 { string \"b\" } AsciiText { string \"c\" } }")
                  .shape);
}

TEST_CASE("an empty file is a frame: no shape, the defaults of a body") {
  const BodySpec b = body("Separator { }");
  CHECK_FALSE(b.shape);
  CHECK(b.mass == doctest::Approx(0.3));
  CHECK(b.material == "wood");
  CHECK_FALSE(b.appearance.given);
}

TEST_CASE("unknown nodes are skipped with a warning, and textures, sounds and routes without one") {
  const TemporaryFolder folder;
  Warnings warnings;
  const auto file = folder.write("odd.iv",
                                 "#Inventor V2.1 ascii\nSeparator {\n  Texture2 { filename "
                                 "\"gone.jpg\" }\n  DEF w Whirl { depth 3\n  Cube { } }\n"
                                 "  USE w\n  Cube { }\n}\n");
  CHECK(read_body(file, warnings.options()).shape->mesh().triangles.size() == 12);
  CHECK(warnings.list == std::vector<std::string>{"odd.iv:4: unknown node 'Whirl' is skipped"});

  warnings.list.clear();
  const auto other =
      folder.write("odd.wrl",
                   "#VRML V2.0 utf8\nDEF T Transform { children [ Whirl { } Shape { appearance "
                   "Appearance { texture ImageTexture { url \"x.png\" } }\n"
                   "geometry Box { } } Shape { geometry Whirl { } } ] }\nDEF C TimeSensor { "
                   "}\nROUTE C.fraction_changed TO T.whatever\nSound { }\n");
  CHECK(read_body(other, warnings.options()).shape->mesh().triangles.size() == 12);
  CHECK(warnings.list.size() == 2);
}

TEST_CASE("an included file is found beside the one that includes it, and read once") {
  const TemporaryFolder folder;
  folder.write("parts/inner/bolt.iv", "#Inventor V2.1 ascii\nCube { width 2 height 2 depth 2 }\n");
  folder.write("parts/plate.wrl",
               "#VRML V2.0 utf8\nTransform { translation 10 0 0 children [ Inline { url "
               "\"inner\\\\BOLT.iv\" } ] }\n");
  const auto file = folder.write("whole.iv",
                                 "#Inventor V2.1 ascii\nSeparator { Translation { translation 0 5 "
                                 "0 } File { name \"parts/inner/bolt.iv\" } "
                                 "File { name parts/plate.wrl } }\n");
  const BodySpec b = read_body(file);
  CHECK(b.shape->mesh().triangles.size() == 24);
  check_box(b, {-0.001, 0.004, -0.001}, {0.011, 0.006, 0.001});
}

TEST_CASE("an Inline stands alone, or in a Transform beside others") {
  const TemporaryFolder folder;
  folder.write("box.wrl", "#VRML V2.0 utf8\nShape { geometry Box { size 10 20 30 } }\n");
  const auto alone = folder.write("alone.wrl", "#VRML V2.0 utf8\nInline { url \"box.wrl\" }\n");
  check_box(read_body(alone), {-0.005, -0.01, -0.015}, {0.005, 0.01, 0.015});
  const auto two = folder.write(
      "two.wrl",
      "#VRML V2.0 utf8\nTransform { children [ Inline { url \"box.wrl\" } Transform { translation "
      "50 0 0 children Inline { url [ \"box.wrl\" ] } } ] }\n");
  check_box(read_body(two), {-0.005, -0.01, -0.015}, {0.055, 0.01, 0.015});
}

TEST_CASE("files that include one another in a circle are refused") {
  const TemporaryFolder folder;
  folder.write("b.iv", "#Inventor V2.1 ascii\nFile { name \"a.iv\" }\n");
  const auto file = folder.write("a.iv", "#Inventor V2.1 ascii\n\nFile { name \"b.iv\" }\n");
  CHECK_THROWS_WITH_AS(read_body(file), "a.iv:3: b.iv:2: 'a.iv' includes itself", Error);
}

TEST_CASE("a chain of included files has an end") {
  const TemporaryFolder folder;
  for (int i = 0; i < 40; ++i)
    folder.write(fmt::format("f{}.iv", i),
                 fmt::format("#Inventor V2.1 ascii\nFile {{ name \"f{}.iv\" }}\n", i + 1));
  CHECK_THROWS_WITH_AS(
      read_body(folder.path() / "f0.iv"),
      "f0.iv:2: f31.iv:2: 'f32.iv': expected files that include one another at most 32 deep",
      Error);
}

TEST_CASE("a file may be included ten thousand times, and no more often") {
  const TemporaryFolder folder;
  folder.write("empty.iv", "#Inventor V2.1 ascii\nSeparator { }\n");
  const auto read = [&](int count, const std::string& node) {
    std::string text = "#Inventor V2.1 ascii\n";
    for (int i = 0; i < count; ++i) text += node;
    return read_body(folder.write("many.iv", text));
  };
  CHECK_NOTHROW(read(10'000, "File { name \"empty.iv\" }\n"));
  CHECK_THROWS_WITH_AS(
      read(10'001, "File { name \"empty.iv\" }\n"),
      "many.iv:10002: expected at most 10000 included files, each counted as often as it is named",
      Error);
  CHECK_THROWS_WITH_AS(
      read(10'001, "WWWInline { name \"empty.iv\" }\n"),
      "many.iv:10002: expected at most 10000 included files, each counted as often as it is named",
      Error);
}

TEST_CASE("a file included again is not read again") {
  const TemporaryFolder folder;
  // two megabytes included ten thousand times would take half a minute
  folder.write("large.iv", "#Inventor V2.1 ascii\n" + std::string(2 << 20, '\n'));
  std::string text = "#Inventor V2.1 ascii\n";
  for (int i = 0; i < 10'000; ++i) text += "File { name \"large.iv\" }\n";
  const auto file = folder.write("many.iv", text);
  const auto start = std::chrono::steady_clock::now();
  read_body(file);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
}

TEST_CASE("nodes that use one another have a limit of depth") {
  std::string text = "DEF g0 Group { }\n";
  for (int i = 1; i < 600; ++i)
    text += "DEF g" + std::to_string(i) + " Group { USE g" + std::to_string(i - 1) + " }\n";
  CHECK_THROWS_WITH_AS(body(text), "body.iv:502: expected nodes at most 500 deep", Error);
}

TEST_CASE("nodes shared a hundred thousand fold have a limit") {
  std::string text = "DEF g0 Group { }\n";
  for (int i = 1; i < 40; ++i) {
    const std::string below = "USE g" + std::to_string(i - 1) + " ";
    text += "DEF g" + std::to_string(i) + " Group { " + below + below + " }\n";
  }
  CHECK_THROWS_WITH_AS(body(text),
                       "body.iv:2: expected at most 2000000 nodes, shared ones counted each time",
                       Error);
}

TEST_CASE("one color is the body's, several are one per triangle") {
  const Appearance one =
      body("Separator { Material { diffuseColor 1 0.5 0 transparency 0.25 } Cube { } }").appearance;
  CHECK(one.given);
  CHECK(one.color == Eigen::Vector3f(1, 0.5f, 0));
  CHECK(one.transparency == 0.25f);
  CHECK(one.triangle_colors.empty());

  const BodySpec two = body(
      "Separator { Material { diffuseColor 1 0 0 } Cube { } Material { diffuseColor 0 0 1 } Cube { "
      "} }");
  CHECK(two.appearance.color.x() == doctest::Approx(0.5));
  REQUIRE(two.appearance.triangle_colors.size() == two.shape->mesh().triangles.size());
  CHECK(two.appearance.triangle_colors[0] == Eigen::Vector3f(1, 0, 0));
  CHECK(two.appearance.triangle_colors[23] == Eigen::Vector3f(0, 0, 1));
  CHECK_FALSE(body("Cube { }").appearance.given);
}

TEST_CASE("nodes that stand inside a shape, as in old files, are its own") {
  const std::string old = "#Inventor V1.0 ascii";
  const auto colors = [&](const std::string& nodes, const std::string& header) {
    const BodySpec b = body("Separator { " + square + nodes + " }", header);
    REQUIRE(b.appearance.triangle_colors.size() > 1);
    std::vector<Eigen::Vector3f> out;
    for (const auto& c : b.appearance.triangle_colors) out.push_back(c.head<3>());
    return out;
  };
  const std::string red = "Material { diffuseColor 1 0 0 # \"red\" }\n}",
                    green = "Material { diffuseColor 0 1 0 } ";
  for (const std::string& shape :
       {"FaceSet { " + red + " numVertices 3 }", "FaceSet { numVertices 3 " + red + " }",
        "FaceSet {\n numVertices [ 3 ]\n DEF hue " + red + "\n}",
        "IndexedFaceSet { Normal { vector [0 0 1] } " + red + " coordIndex [ 0, 1, 2 ] }",
        "DEF face FaceSet { " + red + " numVertices 3 }"}) {
    INFO(shape);
    // only for this shape: the next face has the color set before
    const auto found = colors(green + shape + " FaceSet { numVertices 3 }", old);
    REQUIRE(found.size() == 2);
    CHECK(found[0].x() == 1);
    CHECK(found[1].y() == 1);
  }
  const auto used = colors("Switch { whichChild -1 DEF red " + red + " }" + green +
                               "FaceSet { USE red numVertices 3 } FaceSet { numVertices 3 }",
                           old);
  CHECK(used[0].x() == 1);
  CHECK(used[1].y() == 1);
  // in a shape's field it remains local
  CHECK(body("FaceSet { vertexProperty DEF v VertexProperty { vertex [ 0 0 0, 10 0 0, 10 10 0 ] } "
             "numVertices 3 }",
             old)
            .shape->mesh()
            .triangles.size() == 1);
}

TEST_CASE("what is lifted out of a shape leaves lines as they are, and a file there is skipped") {
  const TemporaryFolder folder;
  const std::string head = "#Inventor V1.0 ascii\n";
  CHECK_THROWS_WITH_AS(
      read_body(folder.write("a.iv", head + square +
                                         "FaceSet {\n Material {\n diffuseColor 1 0 0\n }\n "
                                         "numVertices 3\n}\nCube { width x }\n")),
      "a.iv:9: Cube: width: expected a number, got 'x'", Error);
  Warnings warnings;
  read_body(
      folder.write("b.iv", head + square + "FaceSet {\n File { name \"b.iv\" } numVertices 3 }"),
      warnings.options());
  CHECK(warnings.list == std::vector<std::string>{"b.iv:4: File inside FaceSet is skipped"});
}

TEST_CASE("faces have the colors that their binding gives them") {
  const std::string head =
      "Separator { " + square +
      "Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1 ] } MaterialBinding { value ";
  const std::string faces = "IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 2, 3, -1 ] ";
  const Eigen::Vector3f red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1);
  const auto colors = [&](const std::string& nodes) {
    return body(nodes).appearance.triangle_colors;
  };
  CHECK(body(head + "OVERALL } " + faces + "} }").appearance.color == red);
  CHECK(colors(head + "PER_FACE } " + faces + "} }") == std::vector{red, green});
  CHECK(colors(head + "PER_FACE_INDEXED } " + faces + "materialIndex [ 2, 1 ] } }") ==
        std::vector{blue, green});
  CHECK(colors(head + "PER_VERTEX } " + faces + "} }") ==
        std::vector{red, blue});  // corners 0 and 3
  CHECK(colors(head + "PER_VERTEX_INDEXED } " + faces +
               "materialIndex [ 1,1,1,-1,2,2,2,-1 ] } }") == std::vector{green, blue});
  // indices that do not match are harmless
  CHECK(colors(head + "PER_FACE_INDEXED } " + faces + "materialIndex [ 2 ] } }") ==
        std::vector{blue, red});
  CHECK(body(head + "PER_FACE_INDEXED } " + faces + "materialIndex [ 99, 99 ] } }")
            .appearance.color == blue);

  const std::string vrml_faces =
      "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } "
      "coordIndex [ 0 1 2 -1 0 2 3 -1 ]\n"
      "color Color { color [ 1 0 0, 0 1 0, 0 0 1 ] } ";
  CHECK(vrml(vrml_faces + "colorPerVertex FALSE } }").appearance.triangle_colors ==
        std::vector{red, green});
  CHECK(
      vrml(vrml_faces + "colorPerVertex FALSE colorIndex [ 2 1 ] } }").appearance.triangle_colors ==
      std::vector{blue, green});
  CHECK(vrml(vrml_faces + "colorPerVertex TRUE } }").appearance.color == red);
}

TEST_CASE("every header is read, and comments before it do not count") {
  for (const auto* header : {"#Inventor V1.0 ascii", "#Inventor V2.0 ascii",
                             "#Inventor V2.1 ascii  made by hand", "#VRML V1.0 ascii"})
    CHECK(body("Separator { Cube { } }", header).shape->mesh().triangles.size() == 12);
  CHECK(body("Separator { Cube { } }", "#mass 100\n\n#Inventor V2.1 ascii").mass ==
        doctest::Approx(0.1));
  CHECK(body("Separator { Cube { } }", "\xEF\xBB\xBF#Inventor V2.1 ascii").shape);
  CHECK_THROWS_WITH_AS(body("Separator { Cube { width x } }", "#mass 100\n#Inventor V2.1 ascii"),
                       "body.iv:3: Cube: width: expected a number, got 'x'", Error);
}

TEST_CASE("the same text with other line ends is the same body") {
  const TemporaryFolder folder;
  const BodySpec b = read_body(
      folder.write("b.iv", "#Inventor V2.1 ascii\r\n#mass 50\r\nCube {\r\n width 4 }\r\n"));
  CHECK(b.mass == doctest::Approx(0.05));
  CHECK(b.shape->bounds().size().x() == doctest::Approx(0.004));
}

TEST_CASE("Units are told, for they scale what nobody may expect to be scaled") {
  const test::TemporaryFolder folder;
  ReadOptions options;
  std::vector<std::string> notes;
  options.diagnostics =
      test::Listening{.note = [&](const std::string& sentence) { notes.push_back(sentence); }};
  const auto file = folder.write(
      "inch.iv", "#Inventor V2.1 ascii\nUnits { units INCHES }\nCube { width 1000 }\n");
  const BodySpec body = read_body(file, options);
  // 0.0254 is a 32-bit number there
  CHECK(body.shape->bounds().size().x() == doctest::Approx(0.0254).epsilon(1e-6));
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].starts_with("inch.iv: Units INCHES scales the nodes after it"));
}

TEST_CASE("a file without a surface is a frame, which is told") {
  const test::TemporaryFolder folder;
  ReadOptions options;
  std::vector<std::string> doubts;
  options.diagnostics =
      test::Listening{.suspect = [&](const std::string& sentence) { doubts.push_back(sentence); }};
  CHECK(
      !read_body(folder.write("none.iv", "#Inventor V2.1 ascii\nSeparator { }\n"), options).shape);
  CHECK(doubts == std::vector<std::string>{
                      "none.iv: no surface: the body is a frame, which touches nothing"});
}

TEST_CASE(
    "a shape in an included file is told with both files, and one that a PROTO makes with the "
    "PROTO's line") {
  const test::TemporaryFolder folder;
  const std::string bad = "Separator {\n FaceSet { numVertices [3] }\n}\n";
  folder.write("part.iv", "#Inventor V2.1 ascii\n\n" + bad);
  const auto outer = folder.write(
      "outer.iv", "#Inventor V2.1 ascii\nFaceSet { numVertices [] }\nFile { name \"part.iv\" }\n");
  CHECK_THROWS_WITH_AS(
      read_body(outer),
      "outer.iv: part.iv:4: FaceSet: number 0 of numVertices: expected 3 points, got 1", Error);
  const auto proto = folder.write(
      "proto.wrl",
      "#VRML V2.0 utf8\nPROTO P [ ] {\n  Shape { geometry IndexedFaceSet { coordIndex [0 1 2 -1] } "
      "}\n}\nGroup { }\nP { }\n");
  CHECK_THROWS_WITH_AS(
      read_body(proto),
      "proto.wrl:3: IndexedFaceSet: number 0 of coordIndex: expected -1 or one of 0 "
      "points, got 0",
      Error);
}

TEST_CASE("names of inlined files are ours to read, whatever stands in them") {
  const test::TemporaryFolder folder;
  for (const std::string name : {"%n%s%n", "100%.wrl", "%99999999d"}) {
    for (const auto& [file, text] : std::vector<std::pair<std::string, std::string>>{
             {"a.wrl", "#VRML V2.0 utf8\nInline { url \"" + name + "\" }\n"},
             {"b.wrl", "#VRML V2.0 utf8\nInline { url [\"" + name + "\" \"%n\"] }\n"},
             {"c.wrl", "#VRML V1.0 ascii\nWWWInline { name \"" + name + "\" }\n"},
             {"d.iv", "#Inventor V2.1 ascii\nFile { name \"" + name + "\" }\n"}}) {
      INFO(text);
      CHECK_THROWS_WITH_AS(read_body(folder.write(file, text)),
                           (file + ":2: no such file: " + name).c_str(), Error);
    }
  }
  folder.write("part.wrl", "#VRML V2.0 utf8\nShape { geometry Box { } }\n");
  const auto list =
      folder.write("l.wrl", "#VRML V2.0 utf8\nInline { url [\"part.wrl\", \"other.wrl\"] }\n");
  CHECK(read_body(list).shape);
}
