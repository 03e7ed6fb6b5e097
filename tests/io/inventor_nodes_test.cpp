// Effects of single nodes of Inventor and VRML on triangles.
#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;
using Eigen::Vector3d;

namespace {

BodySpec read_nodes(const std::string& nodes, const ReadOptions& options = {},
                    const std::string& header = "#Inventor V2.1 ascii") {
  const TemporaryFolder folder;
  return read_body(folder.write("a.iv", header + "\n" + nodes), options);
}

BodySpec read_vrml_nodes(const std::string& nodes, const ReadOptions& options = {}) {
  return read_nodes(nodes, options, "#VRML V2.0 utf8");
}

size_t triangles_of(const BodySpec& body) {
  return body.shape ? body.shape->mesh().triangles.size() : 0;
}

/// [mm]
void check_bounds(const BodySpec& body, const Vector3d& low, const Vector3d& high) {
  REQUIRE(body.shape);
  CHECK((body.shape->bounds().low * 1000 - low).norm() < 1e-4);
  CHECK((body.shape->bounds().high * 1000 - high).norm() < 1e-4);
}

}  // namespace

TEST_CASE("copies stand in their rows, from the first, about the middle, or back from the last") {
  const std::string rows =
      "Array { numElements1 3 separation1 10 0 0 numElements2 2 separation2 0 5 0 Cube { } origin ";
  check_bounds(read_nodes(rows + "FIRST }"), {-1, -1, -1}, {21, 6, 1});
  check_bounds(read_nodes(rows + "CENTER }"), {-11, -3.5, -1}, {11, 3.5, 1});
  check_bounds(read_nodes(rows + "LAST }"), {-21, -6, -1}, {1, 1, 1});
  CHECK(triangles_of(read_nodes("Array { numElements1 0 Cube { } }")) == 0);
  check_bounds(
      read_nodes("MultipleCopy { matrix [ 1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1, 2 0 0 0 0 2 0 0 "
                 "0 0 2 0 0 0 0 1 ] Cube { } }"),
      {-2, -2, -2}, {6, 2, 2});
}

TEST_CASE("negative sizes of shapes count by their magnitude and are told with their line") {
  const auto volume = [](const BodySpec& body) { return body.shape->solid().volume; };
  for (const char* shape :
       {"Cube { width -8 depth 3 }", "Sphere { radius -10 }", "Cylinder { radius -3 height -5 }",
        "Cone { bottomRadius -3 height 5 }"}) {
    CAPTURE(shape);
    Warnings warnings;
    const BodySpec body = read_nodes(shape, warnings.options());
    std::string positive = shape;
    std::erase(positive, '-');
    CHECK(volume(body) == volume(read_nodes(positive)));
    REQUIRE(!warnings.list.empty());
    CHECK(warnings.list[0].starts_with("a.iv:2: "));
    CHECK(warnings.list[0].find("is negative; ") != std::string::npos);
  }
  Warnings warnings;
  const std::string box = "Shape { geometry Box { size -4 4 -4 } }";
  CHECK(volume(read_nodes(box, warnings.options(), "#VRML V2.0 utf8")) > 0);
  CHECK(warnings.list.size() == 1);
}

TEST_CASE("a transform ends with its separator, a reset takes back those before") {
  const std::string move = "Translation { translation 100 0 0 } ";
  check_bounds(read_nodes("TransformSeparator { " + move + "} Cube { }"), {-1, -1, -1}, {1, 1, 1});
  check_bounds(read_nodes(move + "ResetTransform { } Cube { }"), {-1, -1, -1}, {1, 1, 1});
  check_bounds(read_nodes(move + "ResetTransform { whatToReset BBOX } Cube { }"), {99, -1, -1},
               {101, 1, 1});
  check_bounds(read_nodes(move + "ResetTransform { whatToReset ( BBOX|TRANSFORM ) } Cube { }"),
               {-1, -1, -1}, {1, 1, 1});
  for (const std::string apart : {"Annotation", "Selection", "WWWAnchor", "Separator"})
    check_bounds(read_nodes(apart + " { " + move + "} Cube { }"), {-1, -1, -1}, {1, 1, 1});
}

TEST_CASE("of levels of detail the finest stands, which is the first") {
  const std::string levels = " Cube { } Sphere { } }";
  CHECK(triangles_of(read_nodes("LOD { range [ 10, 20 ] center 1000 0 0" + levels)) == 12);
  CHECK(triangles_of(read_nodes("LevelOfDetail { screenArea [ 10 ]" + levels)) == 12);
  CHECK(triangles_of(read_vrml_nodes("LOD { range 10 level [ Shape { geometry Box { } } Shape { "
                                     "geometry Sphere { } } ] }")) == 12);
}

TEST_CASE("a VRML switch shows its choice") {
  const auto shown = [](const std::string& choice) {
    return triangles_of(read_vrml_nodes("Switch { " + choice +
                                        " choice [ Shape { geometry Box { } } Shape { geometry "
                                        "Cone { } } ] }"));
  };
  CHECK(shown("") == 0);
  CHECK(shown("whichChoice 0") == 12);
  CHECK(shown("whichChoice 1") == 38);
  CHECK(shown("whichChoice 2") == 0);
}

TEST_CASE("parts of cylinders and cones are left out when the file says so") {
  CHECK(triangles_of(read_nodes("Cylinder { parts SIDES }")) == 40);
  CHECK(triangles_of(read_nodes("Cylinder { parts (SIDES | TOP) }")) == 58);
  CHECK(triangles_of(read_nodes("Cone { parts ( SIDES ) }")) == 20);
  CHECK(triangles_of(read_vrml_nodes("Shape { geometry Cone { side FALSE } }")) == 18);
  CHECK(triangles_of(read_vrml_nodes("Shape { geometry Cylinder { top FALSE bottom 0 } }")) == 40);
}

TEST_CASE("complexity says how finely round shapes are cut") {
  CHECK(triangles_of(read_nodes("Complexity { value 1 } Cylinder { }")) == 156);
  CHECK(triangles_of(read_nodes("Complexity { value 0 } Cylinder { }")) == 12);
  CHECK(triangles_of(read_nodes("Complexity { value -1e30 } Sphere { }")) == 8);
  CHECK(triangles_of(read_nodes("Complexity { value 1e30 } Sphere { }")) == 1680);
  Warnings warnings;
  read_nodes("\nComplexity { type SCREEN_SPACE value 1 } Cube { }", warnings.options());
  CHECK(warnings.list ==
        std::vector<std::string>{"a.iv:3: Complexity: SCREEN_SPACE is read as OBJECT_SPACE"});
}

TEST_CASE("each side of a cube and each part of a round shape has its color where parts have") {
  const std::string colors =
      "Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1 ] } MaterialBinding { value ";
  const auto seen = [&](const std::string& nodes) {
    const auto list = read_nodes(colors + nodes).appearance.triangle_colors;
    return std::array{std::ranges::count(list, Eigen::Vector3f(1, 0, 0)),
                      std::ranges::count(list, Eigen::Vector3f(0, 1, 0)),
                      std::ranges::count(list, Eigen::Vector3f(0, 0, 1))};
  };
  CHECK(seen("PER_PART } Cube { }") == std::array<long, 3>{2, 2, 8});
  CHECK(seen("PER_FACE } Cube { }") == std::array<long, 3>{2, 2, 8});
  CHECK(seen("PER_PART } Cylinder { }") == std::array<long, 3>{40, 18, 18});
  CHECK(seen("PER_PART } Cone { }") == std::array<long, 3>{20, 18, 0});
  CHECK(seen("OVERALL } Cylinder { }") == std::array<long, 3>{0, 0, 0});
}

TEST_CASE("packed colors carry their transparency, a base color keeps the one before") {
  const Appearance packed =
      read_nodes("PackedColor { orderedRGBA 0xff000080 } Cube { }").appearance;
  CHECK(packed.color == Eigen::Vector3f(1, 0, 0));
  CHECK(packed.transparency == doctest::Approx(127.0 / 255));
  const Appearance base =
      read_nodes("Material { transparency 0.25 } BaseColor { rgb 0 1 0 } Cube { }").appearance;
  CHECK(base.color == Eigen::Vector3f(0, 1, 0));
  CHECK(base.transparency == 0.25f);
}

TEST_CASE("an extrusion sweeps its outline along its spine, closed by caps") {
  const auto volume = [](const std::string& fields) {
    const BodySpec body = read_vrml_nodes("Shape { geometry Extrusion { " + fields + " } }");
    CHECK(body.shape->closed());
    return body.shape->solid().volume * 1e9;
  };
  CHECK(volume("") == doctest::Approx(4));
  CHECK(volume("ccw FALSE") == doctest::Approx(4));  // facing outward
  CHECK(volume("spine [ 0 0 0, 0 5 0 ] scale [ 1 1, 2 2 ]") ==
        doctest::Approx(5.0 / 3 * (4 + 16 + 8)));
  CHECK(volume("spine [ 0 0 0, 3 0 0 ]") == doctest::Approx(12));
  CHECK(volume("spine [ 0 0 0, 0 -3 0 ]") == doctest::Approx(12));
  CHECK(volume("spine [ 0 0 0, 1 2 2 ] orientation [ 0 1 0 0.3 ]") == doctest::Approx(12));
  // an outline that is not convex; then a spine with a corner, which gives two mitred prisms
  CHECK(volume("convex FALSE crossSection [ 0 0, 0 4, 2 1, 4 4, 4 0, 0 0 ]") ==
        doctest::Approx(16 - 6));
  CHECK(volume("spine [ 0 0 0, 0 10 0, 10 10 0 ] crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ]") >
        0);
  // a ring needs no caps
  CHECK(volume("spine [ 5 0 0, 0 0 5, -5 0 0, 0 0 -5, 5 0 0 ]") > 50);
  CHECK(triangles_of(
            read_vrml_nodes("Shape { geometry Extrusion { beginCap FALSE endCap FALSE } }")) == 8);
  CHECK(triangles_of(read_vrml_nodes("Shape { geometry Extrusion { spine [ 0 0 0 ] } }")) == 0);
}

TEST_CASE("a PROTO's instance has its own values, or those of the PROTO") {
  const std::string proto =
      "PROTO Ball [ field SFFloat r 2 exposedField SFVec3f at 0 0 0 field SFNode look NULL eventIn "
      "SFTime start ]\n{ Transform { translation IS at children Shape { appearance Appearance { "
      "material IS look } geometry Box { size IS size_of } } } }\n";
  CHECK_THROWS_WITH_AS(
      read_vrml_nodes(proto + "Ball { }"),
      "a.iv:3: Box: size: expected a field of a PROTO around it after IS, got 'size_of'", Error);
  const std::string box =
      "PROTO Block [ field SFVec3f size 2 2 2 exposedField SFVec3f at 0 0 0 field MFNode more [ ] "
      "]\n"
      "{ Transform { translation IS at children Shape { geometry Box { size IS size } } }\n"
      "  Group { children IS more } }\n";
  check_bounds(read_vrml_nodes(box + "Block { }"), {-1, -1, -1}, {1, 1, 1});
  check_bounds(read_vrml_nodes(box + "Block { at 10 0 0 size 4 6 8 }"), {8, -3, -4}, {12, 3, 4});
  check_bounds(read_vrml_nodes(box + "DEF b Block { more [ Block { at 5 0 0 } ] }\nTransform { "
                                     "translation 0 10 0 children USE b }"),
               {-1, -1, -1}, {6, 11, 1});
  CHECK_THROWS_WITH_AS(read_vrml_nodes(box + "Block { sise 1 2 3 }"),
                       "a.iv:5: PROTO 'Block' has no field 'sise'", Error);
  // names within a PROTO are local
  CHECK_THROWS_WITH_AS(read_vrml_nodes("PROTO P [ ] { DEF x Group { } }\nP { }\nUSE x"),
                       "a.iv:4: USE of 'x', which nothing above defines", Error);
  // as the value of a field it is its first node
  check_bounds(read_vrml_nodes("PROTO G [ field SFFloat r 1 ] { Box { size 4 4 4 } Group { } }\n"
                               "Shape { geometry G { } }"),
               {-2, -2, -2}, {2, 2, 2});
}

TEST_CASE(
    "USE names the nearest node above in its own scope, one inside another of that name too") {
  CHECK(triangles_of(read_nodes("DEF A Separator { DEF A Cube { } USE A }")) == 24);
  CHECK(triangles_of(read_nodes(
            "DEF A Separator { DEF A Separator { DEF A Cube { } } USE A } USE A")) == 48);
  CHECK_THROWS_WITH_AS(read_nodes("DEF A Separator {\nDEF A Separator { USE A } }"),
                       "a.iv:3: USE of 'A' inside itself, which line 3 defines", Error);
  const std::string proto =
      "PROTO P [ field SFNode x NULL ] { Group { children [\n"
      "DEF A Shape { geometry Box { } } USE A Group { children IS x } ] } }\n";
  CHECK(triangles_of(read_vrml_nodes(proto + "DEF A Group { children [ P { } ] }")) == 24);
  CHECK_THROWS_WITH_AS(read_vrml_nodes(proto + "DEF A Group { children [ P { x USE A } ] }"),
                       "a.iv:4: USE of 'A' inside itself, which line 4 defines", Error);
}

TEST_CASE("brackets and names in strings are text") {
  for (const std::string text : {"{", "[", "}", "]", "map", "DEF", "Cube"})
    CHECK(triangles_of(read_nodes("WWWAnchor { description \"" + text + "\" Cube { } }")) == 12);
  const std::string proto = "PROTO P [ field SFString s \"\" field SFNode x NULL ] { Group { } }\n";
  for (const std::string text : {"{", "[", "x"})
    CHECK(triangles_of(read_vrml_nodes(proto + "P { s \"" + text +
                                       "\" x NULL } Shape { geometry Box { } }")) == 12);
}

TEST_CASE("points that lines share with faces are read with them") {
  CHECK(triangles_of(read_vrml_nodes("Shape { geometry IndexedLineSet { coord DEF c Coordinate { "
                                     "point [ 0 0 0, 1 0 0, 0 1 0 ] } "
                                     "coordIndex [ 0 1 2 ] } }\nShape { geometry IndexedFaceSet { "
                                     "coord USE c coordIndex [ 0 1 "
                                     "2 ] } }")) == 1);
  CHECK(
      triangles_of(read_nodes("LineSet { vertexProperty DEF v VertexProperty { vertex [ 0 0 0, 1 0 "
                              "0, 0 1 0 ] } }\nFaceSet { vertexProperty USE v }")) == 1);
}

TEST_CASE("what is not read is told by name and line") {
  Warnings warnings;
  CHECK(triangles_of(read_nodes("Rotor { speed 3 }\nSeparatorKit { }\nNurbsSurface { }\nCube { }\n"
                                "PathSwitch { Cube { } }\nFile { }",
                                warnings.options())) == 12);
  CHECK(warnings.list == std::vector<std::string>{"a.iv:2: node 'Rotor' is skipped",
                                                  "a.iv:3: unknown node 'SeparatorKit' is skipped",
                                                  "a.iv:6: node 'PathSwitch' is skipped",
                                                  "a.iv:7: File names no file",
                                                  "a.iv: NurbsSurface is not used as geometry"});
}

TEST_CASE("what cannot be understood is told by line, expected and got") {
  const auto refusal = [](const std::string& nodes) {
    try {
      read_nodes(nodes);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal("Separator Cube { }") == "a.iv:2: expected '{' after 'Separator', got 'Cube'");
  CHECK(refusal("\"text\"") == "a.iv:2: expected a node, got 'text'");
  CHECK(refusal("DEF { }") == "a.iv:2: expected a name after DEF, got '{'");
  CHECK(refusal("DEF a { }") == "a.iv:2: expected a node type after DEF and a name, got '{'");
  CHECK(refusal("USE [") == "a.iv:2: expected a name after USE, got '['");
  CHECK(refusal("ROUTE a.b OT c.d") ==
        "a.iv:2: expected ROUTE, a field's name, TO and another's name");
  CHECK(refusal("DEF hub Cube { } USE hubb") ==
        "a.iv:2: USE of 'hubb', which nothing above defines; did you mean 'hub'?");
  CHECK(refusal("Separator { { } }") == "a.iv:2: expected a node type before '{', got nothing");
  CHECK(refusal("Cube { width }") == "a.iv:2: Cube: width: expected a number, got '}'");
  CHECK(refusal("Translation { translation 1 2 }") ==
        "a.iv:2: Translation: translation: expected a number, got '}'");
  CHECK(refusal("Coordinate3 { point [ 1 2 ] }") ==
        "a.iv:2: Coordinate3: point: expected a number, got ']'");
  CHECK(refusal("FaceSet { startIndex 1.5 }") ==
        "a.iv:2: FaceSet: startIndex: expected a whole number from -2147483648 to 2147483647, got "
        "'1.5'");
  CHECK(refusal("Units { units LIGHTYEARS }")
            .starts_with("a.iv:2: Units: units: expected one of METERS, "));
  CHECK(refusal("Cylinder { parts (SIDES | LID) }") ==
        "a.iv:2: Cylinder: parts: expected one of SIDES, TOP, BOTTOM, ALL, got 'LID'");
  CHECK(refusal("RotationXYZ { axis (|) }") ==
        "a.iv:2: RotationXYZ: axis: expected one of X, Y, Z, got '(|)'");
  CHECK(refusal("FaceSet { vertexProperty Cube { } }") ==
        "a.iv:2: FaceSet: vertexProperty: expected a VertexProperty, got Cube");
  CHECK(refusal("Cube { width IS w }") ==
        "a.iv:2: Cube: width: expected a field of a PROTO around it after IS, got 'w'");
  CHECK(refusal("PROTO P { }") == "a.iv:2: expected '[' after PROTO 'P', got '{'");
  CHECK(refusal("PROTO P [ fild SFBool b TRUE ] { }") ==
        "a.iv:2: expected field, exposedField, eventIn, eventOut or ']', got 'fild'");
  CHECK(refusal("PROTO P [ ] Cube { }") ==
        "a.iv:2: expected '{' after PROTO 'P' and its fields, got 'Cube'");
  CHECK(refusal("Cube \"{\" }") == "a.iv:2: expected '{' after 'Cube', got '{'");
  CHECK(refusal("PROTO P \"[\" ] { }") == "a.iv:2: expected '[' after PROTO 'P', got '['");
  CHECK(refusal("PROTO P [ ] \"{\" }") ==
        "a.iv:2: expected '{' after PROTO 'P' and its fields, got '{'");
  CHECK(refusal("Cube { width 1 = Engine \"{\" }") ==
        "a.iv:2: expected '{' after the node type, got '{'");
  CHECK(refusal("Cube { width 1 = USE a \".b\" }") == "a.iv:2: Cube: unknown field '.b'");
  CHECK(refusal("Cube { \"width\" 1 }") == "a.iv:2: Cube: unknown field 'width'");
  CHECK(refusal("File { name [ ] ] }") == "a.iv:2: expected '}' for the '{' of line 2, got ']'");
}
