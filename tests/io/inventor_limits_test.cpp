// Inventor and VRML files designed to crash, to run code, to hang or to exhaust the memory: they
// give an error, or a body without the hostile part.
#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/io/read/read.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

namespace {

const std::string iv = "#Inventor V2.1 ascii\n", wrl = "#VRML V2.0 utf8\n";

std::string repeated(int count, const std::string& text) {
  std::string out;
  for (int i = 0; i < count; ++i) out += text;
  return out;
}

/// Number of triangles of the body, or the error message; followed by the warnings.
struct Outcome {
  std::string sentence, warnings;
  size_t triangles = 0;
};

Outcome read_text_as_body(const std::string& text, const std::string& name = "a.iv") {
  const TemporaryFolder folder;
  Warnings warnings;
  Outcome out;
  try {
    const BodySpec body = read_body(folder.write(name, text), warnings.options());
    out.triangles = body.shape ? body.shape->mesh().triangles.size() : 0;
  } catch (const Error& error) {
    out.sentence = error.what();
  }
  for (const auto& w : warnings.list) out.warnings += w + "\n";
  return out;
}

std::string refusal(const std::string& text) { return read_text_as_body(text).sentence; }

}  // namespace

TEST_CASE("types that a file makes up are no names of libraries: nothing is opened or run") {
  for (const std::string type : {"dl/Evil", "/tmp/Evil", "../Evil", "SFEvil"}) {
    INFO(type);
    for (const std::string& access : {"field " + type + " x 3", "exposedField " + type + " x [ 3 ]",
                                      "eventIn " + type + " x", "eventOut " + type + " x"})
      CHECK(read_text_as_body(wrl + "PROTO P [ " + access + " ] { Group { } }\nP { }\n" +
                              "Shape { geometry Box { } }\n")
                .triangles == 12);
    CHECK(
        read_text_as_body(wrl + "PROTO " + type + " [ ] { Group { } }\nShape { geometry Box { } }")
            .triangles == 12);
    const Outcome old =
        read_text_as_body(iv + "Evil { fields [ " + type + " x ] isA [ SFNode y ] x 3 }\n" +
                          "Cube { fields [ " + type + " x ] }\n");
    CHECK(old.triangles == 12);
    CHECK(old.warnings == "a.iv:2: unknown node 'Evil' is skipped\n");
  }
}

TEST_CASE("messages show the beginning of long integers and words") {
  const std::string digits(520, '1'), word(65'500, 'w'), head(max_excerpt, 'w');
  CHECK(
      refusal(iv + "Switch { whichChild " + digits + " Cube { } }") ==
      "a.iv:2: Switch: whichChild: expected a whole number from -2147483648 to 2147483647, got '" +
          digits.substr(0, max_excerpt) + "...'");
  CHECK(refusal(iv + "PackedColor { orderedRGBA 0x" + digits + " }").ends_with("...'"));
  CHECK(refusal(iv + "Cube { width " + digits + " }") ==
        "a.iv:2: Cube: width: expected a finite number that fits 32 bits, got '" +
            digits.substr(0, max_excerpt) + "...'");
  CHECK(refusal(iv + "Cube { " + word + " }") == "a.iv:2: Cube: unknown field '" + head + "...'");
  CHECK(read_text_as_body(iv + "Cube { " + word + " 3 }").warnings ==
        "a.iv:2: Cube: unknown field '" + head + "...' is skipped\n");
  CHECK(refusal(iv + "RotationXYZ { axis " + word + " }") ==
        "a.iv:2: RotationXYZ: axis: expected one of X, Y, Z, got '" + head + "...'");
  CHECK(refusal(iv + "USE " + word) ==
        "a.iv:2: USE of '" + head + "...', which nothing above defines");
  CHECK(refusal(iv + "DEF " + word + " Group { USE " + word + " }") ==
        "a.iv:2: USE of '" + head + "...' inside itself, which line 2 defines");
  CHECK(refusal(iv + word) ==
        "a.iv:2: expected '{' after '" + head + "...', got the end of the file");
  CHECK(refusal(iv + word + " {").size() < 150);
  CHECK(read_text_as_body(iv + word + " { }")
            .warnings.starts_with("a.iv:2: unknown node '" + head + "...' is skipped\n"));
  CHECK(refusal(wrl + "PROTO " + word + " [ ] " + word).size() < 320);
}

TEST_CASE("what has no part in triangles does no harm, whatever stands in it") {
  const Outcome out = read_text_as_body(
      iv +
      "TextureUnit { unit -1 } Texture2 { image 99999 99999 4 filename \"x\" }\n"
      "Calculator { a [] expression \"oa=a/0\" } SelectOne { index -5 }\n"
      "ShaderProgram { shaderObject [ ] } Text3 { string [ ] parts 99 } Cube { }\n");
  CHECK(out.triangles == 12);
  CHECK(out.warnings == "");
  const Outcome fed = read_text_as_body(
      iv +
      "Translation {\n translation = ComposeVec3f { x [] } . vector\n}\n"
      "DEF e ElapsedTime { } RotationXYZ { angle 0 = USE e.timeOut }\nCube { }\n");
  CHECK(fed.triangles == 12);
  CHECK(fed.warnings ==
        "a.iv:3: Translation: translation is connected, which is not used\n"
        "a.iv:5: RotationXYZ: angle is connected, which is not used\n");
}

TEST_CASE("copies count as nodes that are visited") {
  const std::string limit = ": expected at most 2000000 nodes, shared ones counted each time";
  const std::string huge = "numElements1 30000 numElements2 30000 numElements3 30000";
  CHECK(refusal(iv + "Array { " + huge + " }") == "a.iv:2" + limit);
  CHECK(refusal(iv + "DEF a MultipleCopy { matrix [ " +
                repeated(1500, "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n") +
                "] DEF b MultipleCopy { matrix [ " +
                repeated(1500, "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n") + "] } }") ==
        "a.iv:1502" + limit);
}

TEST_CASE("rows without copies end at once, however many there are") {
  const std::string many = " 2000000000 ";
  for (const std::string& counts :
       {"numElements1 0 numElements2" + many + "numElements3" + many,
        "numElements1" + many + "numElements2 -1 numElements3" + many}) {
    const Outcome out = read_text_as_body(iv + "Array { " + counts + " Cube { } }\nCube { }");
    CHECK(out.sentence == "");
    CHECK(out.triangles == 12);
  }
}

TEST_CASE("triangles without area count as those with one do") {
  const std::string limit = "expected at most 2000000 triangles";
  const std::string copies = "Array { numElements1 999000 ";
  CHECK(refusal(iv + "Complexity { value 1 } " + copies + "Sphere { radius 0 } }") ==
        "a.iv:2: " + limit);
  const std::string extrusion = "geometry DEF e Extrusion { spine [ " + repeated(1000, "0 0 0,") +
                                " ] crossSection [ " + repeated(1000, "0 0,") + " ] }";
  CHECK(refusal(wrl + "Shape { " + extrusion + " }\n" +
                repeated(2000, "Shape { geometry USE e }")) == "a.iv:2: " + limit);
}

TEST_CASE("what shapes list has an end, shared or not, with triangles or without") {
  const std::string limit =
      "a.iv:2: expected shapes that list at most 50000000 numbers, shared ones counted each time";
  const auto copies = [](const std::string& shape) {
    return iv + "Array { numElements1 999000 " + shape + " }";
  };
  const std::string nothing = repeated(200'000, "-1,");
  CHECK(refusal(copies("IndexedFaceSet { coordIndex [ " + nothing + " ] }")) == limit);
  // colors are copied for each shape
  CHECK(refusal(copies("IndexedFaceSet { vertexProperty VertexProperty { orderedRGBA [ " +
                       repeated(200'000, "0,") + " ] } }")) == limit);
  CHECK(refusal(wrl + "DEF s Shape { geometry Extrusion { crossSection [ ] spine [ " +
                repeated(100'000, "0 0 0,") + " ] } }\n" + repeated(999, "USE s ")) == limit);
  // the same word again and again is reported once
  CHECK(read_text_as_body(copies("ResetTransform { whatToReset (" +
                                 repeated(200'000, "TRANSFORM |") + " BBOX) }"))
            .sentence == "");
  // shapes may share any number of points
  CHECK(read_text_as_body(wrl + "DEF s Shape { geometry IndexedFaceSet { coordIndex [ 0 1 2 ] " +
                          "coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 " +
                          repeated(60'000, "0 0 0,") + " ] } } }\n" + repeated(499, "USE s "))
            .triangles == 500);
}

TEST_CASE("a file has at most a million nodes, and ten million values") {
  CHECK(refusal(iv + repeated(1'000'000, "Group{}")) == "a.iv:2: expected at most 1000000 nodes");
  CHECK(refusal(iv + "Normal { }\nIndexedFaceSet { coordIndex [\n" + repeated(10'000'001, "0,") +
                "] }") == "a.iv:4: expected at most 10000000 values of fields");
}

TEST_CASE("names, warnings and PROTOs of a file have an end") {
  CHECK(refusal(iv + repeated(1'000'001, "DEF a X{}")) == "a.iv:2: expected at most 1000000 names");
  CHECK(refusal(wrl + repeated(100'001, "PROTO a[]{}\n")) ==
        "a.iv:100002: expected at most 100000 PROTOs and fields of PROTOs");
  const std::string told = read_text_as_body(iv + repeated(1500, "X{}\n")).warnings;
  CHECK(
      told.find("a.iv:1001: unknown node 'X' is skipped\na.iv: further warnings are left out\n") !=
      std::string::npos);
  CHECK(told.find("a.iv:1002:") == std::string::npos);
  // repairs found during the traversal
  const std::string found =
      read_text_as_body(iv + repeated(1500, "Complexity{type SCREEN_SPACE}\n")).warnings;
  CHECK(found.find("a.iv:1001: Complexity: SCREEN_SPACE is read as OBJECT_SPACE\n"
                   "a.iv: further warnings are left out\n") != std::string::npos);
  CHECK(found.find("a.iv:1002:") == std::string::npos);
  // suggestions are not searched among long names
  std::string named = iv;
  for (int i = 0; i < 50; ++i)
    named += fmt::format("DEF {}{} Group {{ }}\n", std::string(60'000, 'a'), i);
  CHECK(refusal(named + "USE " + std::string(60'000, 'a')).starts_with("a.iv:52: USE of 'aaaa"));
}

TEST_CASE("PROTOs are read again for each instance, with an end") {
  // a default that names the PROTO itself, or an earlier one
  CHECK(refusal(wrl + "PROTO P [ field SFNode x P { } ] { Group { } }\nP { }") ==
        "a.iv:2: PROTO 'P' is used inside a PROTO, which is not read");
  std::string doubled = wrl + "PROTO P0 [ ] { Group { } }\n";
  for (int i = 1; i < 40; ++i)
    doubled += fmt::format(
        "PROTO P{0} [ field MFNode x [ P{1} {{ }} P{1} {{ }} ] ] {{ Group {{ children IS x }} }}\n",
        i, i - 1);
  CHECK(refusal(doubled + "P39 { }") ==
        "a.iv:3: PROTO 'P0' is used inside a PROTO, which is not read");
  // values that contain instances, each used twice
  std::string nested;
  for (int i = 0; i < 40; ++i) nested += "P { x ";
  CHECK(refusal(wrl +
                "PROTO P [ field SFNode x NULL ] { Group { children [ Group { children IS x } "
                "Group { children IS x } ] } }\n" +
                nested + "NULL" + repeated(40, " }")) ==
        "a.iv:2: expected PROTOs that expand to at most 20000000 bytes of text");
  // long bodies
  CHECK(refusal(wrl + "PROTO P [ ] {\n#" + std::string(1 << 20, '-') + "\n}\n" +
                repeated(60, "P { }\n")) ==
        "a.iv:24: expected PROTOs that expand to at most 20000000 bytes of text");
  CHECK(refusal(wrl + "PROTO P [ ] { PROTO Q [ ] { Group { } } }\nP { }") ==
        "a.iv:2: a PROTO inside a PROTO is not read");
}

TEST_CASE("files whose PROTOs stand for one another do not run out of the stack") {
  const TemporaryFolder folder;
  for (int file = 0; file < 31; ++file) {
    std::string text = wrl;
    for (int i = 0; i < 247; ++i) text += fmt::format("PROTO P{} [ ] {{ P{} {{ }} }}\n", i, i + 1);
    text += fmt::format("PROTO P247 [ ] {{ Inline {{ url \"f{}.wrl\" }} }}\nP0 {{ }}\n", file + 1);
    folder.write(fmt::format("f{}.wrl", file), text);
  }
  folder.write("f31.wrl", wrl + "Shape { geometry Box { } }\n");
  CHECK_THROWS_WITH_AS(read_body(folder.path() / "f0.wrl"),
                       "f0.wrl:249: f2.wrl:3: expected nodes at most 500 deep", Error);
}

TEST_CASE("an extrusion has an end") {
  const auto extrusion = [](int spine, int section) {
    std::string points, outline;
    for (int i = 0; i < spine; ++i) points += fmt::format("0 {} 0,", i);
    for (int i = 0; i < section; ++i) outline += fmt::format("{} {},", i, i % 7);
    return wrl + "Shape { geometry Extrusion { spine [ " + points + " ] crossSection [ " + outline +
           " ] } }";
  };
  CHECK(read_text_as_body(extrusion(30, 30)).triangles > 1600);
  CHECK(
      refusal(extrusion(3000, 3000)) ==
      "a.iv:2: Extrusion: expected a spine and a cross section of at most 1000000 points together, "
      "got 3000 x 3000");
}

TEST_CASE("coordinates that leave the range of 32 bits on their way are refused") {
  const std::string scale = "Scale { scaleFactor 1e30 1e30 1e30 }\n";
  CHECK(refusal(iv + scale + scale + "Cube { }") ==
        "a.iv:4: Cube: expected finite coordinates, got (inf, inf, inf)");
  CHECK(refusal(iv + "MatrixTransform { matrix 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 } Cube { }")
            .starts_with("a.iv:2: Cube: expected finite coordinates, got ("));
  CHECK(refusal(iv + "Coordinate4 { point [ 1 0 0 0, 0 1 0 0, 0 0 1 0 ] } FaceSet { }")
            .starts_with("a.iv:2: FaceSet: expected finite coordinates, got ("));
  CHECK(refusal(iv + "Cube { width nan }") ==
        "a.iv:2: Cube: width: expected a finite number that fits 32 bits, got 'nan'");
}

TEST_CASE("closing braces too many are left out, with one warning, and what follows is read") {
  const Outcome out = read_text_as_body(iv + "Separator { Cube { } }\n}\n# the end\n");
  CHECK(out.triangles == 12);
  CHECK(out.warnings == "a.iv:3: '}' closes nothing; it is left out\n");
  const Outcome more = read_text_as_body(iv + "Cube { }\n}\nCube { }\n} } Cube { }");
  CHECK(more.triangles == 36);
  CHECK(more.warnings == "a.iv:3: '}' closes nothing; it is left out (2 more alike)\n");
  CHECK(refusal(iv + "Cube { }\n]") == "a.iv:3: ']' closes nothing");
}
