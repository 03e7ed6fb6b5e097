#include "io/file_kind.h"

#include "base/error.h"
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

TEST_CASE("an ending that no reader has is refused") {
  CHECK_THROWS_WITH_AS(
      file_kind("notes.txt"),
      "notes.txt: wanted a model, a world, eigengrasps or virtual contacts, got '.txt'", Error);
  CHECK_THROWS_WITH_AS(
      file_kind("notes"),
      "notes: wanted a model, a world, eigengrasps or virtual contacts, got nothing", Error);
}
