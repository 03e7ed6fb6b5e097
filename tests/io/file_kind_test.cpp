#include "io/file_kind.h"

#include "base/error.h"
#include "io/find_model.h"
#include "temporary.h"

using namespace clench;

TEST_CASE("the ending tells what a file describes, in any case of letters") {
  CHECK(file_kind("mug.OBJ") == FileKind::body);
  CHECK(file_kind("hand.cfg") == FileKind::robot);
  CHECK(file_kind("hand.urdf") == FileKind::robot);
  CHECK(file_kind("scene.wld") == FileKind::world);
  CHECK(file_kind("hand.egr") == FileKind::eigengrasps);
  CHECK(file_kind("hand.vgr") == FileKind::virtual_contacts);
}

TEST_CASE("the outermost element tells what an XML file describes") {
  const test::TemporaryFolder folder;
  const auto kind = [&](const std::string& text) { return file_kind(folder.write("x.xml", text)); };
  CHECK(kind("<?xml version='1.0'?>\n<!-- <world> -->\n<robot type='Hand'/>") == FileKind::robot);
  CHECK(kind("<mujoco model='hand'/>") == FileKind::robot);
  CHECK(kind("<world/>") == FileKind::world);
  CHECK(kind("<EigenGrasps dimensions='4'/>") == FileKind::eigengrasps);
  CHECK(kind("<virtual_contacts/>") == FileKind::virtual_contacts);
  CHECK(kind("<root/>") == FileKind::body);
}

TEST_CASE("every ending of a body's file is loaded, checked and tried for another, as one list") {
  const test::TemporaryFolder folder;
  for (const auto& ending : body_endings()) {
    INFO(ending);
    if (ending != ".xml") {
      CHECK(file_kind("a" + ending) == FileKind::body);
      CHECK(geometry_format(ending) != GeometryFormat::none);
    }
    // a reader complains of what is in it, not of its name
    const auto file = folder.write("part" + ending, "?");
    std::string refused;
    try {
      read_body(file);
    } catch (const Error& error) {
      refused = error.what();
    }
    CHECK(refused.starts_with("part" + ending));
    CHECK(refused.find("wanted a body from") == std::string::npos);
    // the same part under a name that is gone
    CHECK(find_converted("part.old", folder.path() / "x", ModelKind::body, "", {}) == file);
    std::filesystem::remove(file);
  }
  CHECK(is_inventor("A.VRML"));
  CHECK(one_of(endings_of(GeometryFormat::inventor)) == ".iv, .wrl or .vrml");
  CHECK(one_of({".stl"}) == ".stl");
}

TEST_CASE("an ending that no reader has is refused") {
  CHECK_THROWS_WITH_AS(
      file_kind("notes.txt"),
      "notes.txt: wanted a model, a world, eigengrasps or virtual contacts, got '.txt'", Error);
  CHECK_THROWS_WITH_AS(
      file_kind("notes"),
      "notes: wanted a model, a world, eigengrasps or virtual contacts, got nothing", Error);
}
