#include "clench/io/text/file_kind.h"

#include "clench/base/error.h"
#include "clench/io/graspit/grasp_lists.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/text/find_model.h"
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
    // the reader complains of its contents, not of its name
    const auto file = folder.write("part" + ending, "?");
    std::string refused;
    try {
      read_body(file);
    } catch (const Error& error) {
      refused = error.what();
    }
    CHECK(refused.starts_with("part" + ending));
    CHECK(refused.find("expected a body from") == std::string::npos);
    // the same data under an unknown name
    CHECK(find_converted("part.old", folder.path() / "x", ModelKind::body, Place(), {}) == file);
    std::filesystem::remove(file);
  }
  CHECK(is_inventor("A.VRML"));
  CHECK(one_of(endings_of(GeometryFormat::inventor)) == ".iv, .wrl or .vrml");
  CHECK(one_of({".stl"}) == ".stl");
}

TEST_CASE("an ending that no reader has is refused") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(file_kind("notes.txt"), "no such file: notes.txt", Error);
  CHECK_THROWS_WITH_AS(
      file_kind(folder.write("notes.txt", "")),
      "notes.txt: expected a model, a world, or a file that goes with one, got '.txt'", Error);
  CHECK_THROWS_WITH_AS(
      file_kind(folder.write("notes", "")),
      "notes: expected a model, a world, or a file that goes with one, got nothing", Error);
}

TEST_CASE("a file of numbers is known by how they stand") {
  const test::TemporaryFolder folder;
  const auto kind = [&](const std::string& text) { return file_kind(folder.write("x.txt", text)); };
  CHECK(kind("# list\n[1 2 3][0 0 1][1 0 0]45\n") == FileKind::pregrasps);
  CHECK(kind("0 0 0 0 0 0 0 0 -2\n1 2 3 1 0 0 0 90 0.5\n") == FileKind::planned_grasps);
  CHECK(kind("1 2\n0.1 0.2\n0.3\n") == FileKind::glove_calibration);
  const std::string edge = "1 0 0 0 0 0\n";
  CHECK(kind("1\n1\n" + edge + "1 0 0 0\n1 2 3\n0 0 1\n0.5\n") == FileKind::object_contacts);
  CHECK(kind("1\n1\n" + edge + "1 0 0 0\n0 0 1\n0.5\n") == FileKind::object_contacts);
  CHECK(kind("1\n2\n-1\n1 7 8\n0\n0\n0 0 0 1\n1 2 3\n") == FileKind::glove_poses);
  // with errors in them
  CHECK(kind("1 2\n0.1 x\n0.3\n") == FileKind::glove_calibration);
  CHECK(kind("2 2\n0.1 1\n0.3\n") == FileKind::glove_calibration);
  CHECK(kind("2\n1\n" + edge) == FileKind::object_contacts);
  CHECK(kind("1\n2\n-1\n1 7 8 9 9\n0\n0\n") == FileKind::glove_poses);
  for (const char* text :
       {"", "# 1 2\n", "shopping\n1 2\n", "7\n", "[see 1]\n", "3 apples\n1\n2\n"})
    CHECK_FALSE(kind_of_numbers(text));
}

TEST_CASE("what the lists hold that Clench writes is known again") {
  const test::TemporaryFolder folder;
  write_pregrasps({{.spread = 1}}, folder.path() / "a.txt");
  write_planned_grasps({GraspSpec{.X_OH = Pose{}, .measures = {{"quality", 1.0}}}},
                       folder.path() / "b.txt");
  ObjectContact contact;
  contact.edges = FrictionEdges::Identity(6, 8);
  write_object_contacts({contact, contact}, folder.path() / "c.txt");
  CHECK(file_kind(folder.path() / "a.txt") == FileKind::pregrasps);
  CHECK(file_kind(folder.path() / "b.txt") == FileKind::planned_grasps);
  CHECK(file_kind(folder.path() / "c.txt") == FileKind::object_contacts);
}
