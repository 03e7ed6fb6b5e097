// Text files that begin with the byte order mark that some editors write before UTF-8.
#include "clench/base/text.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/glove_files.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/read/read.h"
#include "clench/io/text/file_kind.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;
namespace fs = std::filesystem;

static const std::string mark = "\xEF\xBB\xBF";

static std::string marked_copy(const TemporaryFolder& folder, const fs::path& from) {
  for (const auto& entry : fs::recursive_directory_iterator(from))
    if (entry.is_regular_file())
      folder.write(fs::relative(entry.path(), from), mark + read_text(entry.path()));
  return folder.path();
}

TEST_CASE("worlds, robots and bodies behind a mark are read as without it") {
  const TemporaryFolder folder;
  const fs::path from = "tests/data/two_finger", to = marked_copy(folder, from);
  Warnings plain, marked;
  const WorldSpec a = read_world(from / "claw.wld", plain.options()),
                  b = read_world(to / "claw.wld", marked.options());
  CHECK(marked.list == plain.list);
  REQUIRE(b.bodies.size() == a.bodies.size());
  for (size_t i = 0; i < a.bodies.size(); ++i)
    CHECK(b.bodies[i].body.shape->hash() == a.bodies[i].body.shape->hash());
  REQUIRE(b.robots.size() == 1);
  CHECK(b.robots[0].dofs == a.robots[0].dofs);
  CHECK(b.robots[0].robot.name == a.robots[0].robot.name);
  CHECK(b.robots[0].robot.base.shape->hash() == a.robots[0].robot.base.shape->hash());
}

TEST_CASE("a robot's tree behind a mark is read as without it") {
  for (const auto& [from, name] :
       {std::pair<fs::path, const char*>{"tests/data/urdf", "gripper.urdf"},
        {"tests/data/mjcf", "hand.mjcf"}}) {
    const TemporaryFolder folder;
    const fs::path to = marked_copy(folder, from);
    Warnings plain, marked;
    const RobotSpec a = read_robot(from / name, plain.options()),
                    b = read_robot(to / name, marked.options());
    CHECK(marked.list == plain.list);
    CHECK(b.name == a.name);
    CHECK(b.dofs.size() == a.dofs.size());
    CHECK(b.links.size() == a.links.size());
    for (size_t d = 0; d < a.dofs.size(); ++d) CHECK(b.dofs[d].name == a.dofs[d].name);
  }
}

TEST_CASE("eigengrasps and virtual contacts behind a mark are read as without it") {
  const TemporaryFolder folder;
  const fs::path from = "models/hands/three_finger", to = marked_copy(folder, from);
  const EigengraspSet grasps = read_eigengrasps(from / "three_finger.egr");
  const VirtualContactSet contacts = read_virtual_contacts(from / "three_finger.vgr");
  CHECK(eigengrasps_xml(read_eigengrasps(to / "three_finger.egr")) == eigengrasps_xml(grasps));
  const VirtualContactSet again = read_virtual_contacts(to / "three_finger.vgr");
  CHECK(again.robot == contacts.robot);
  CHECK(virtual_contacts_xml(again) == virtual_contacts_xml(contacts));
  // the same as XML
  CHECK(read_eigengrasps(folder.write("e.xml", mark + eigengrasps_xml(grasps))).grasps.size() ==
        grasps.grasps.size());
  CHECK(read_virtual_contacts(folder.write("v.xml", mark + virtual_contacts_xml(contacts)))
            .contacts.size() == contacts.contacts.size());
}

TEST_CASE("lists of numbers behind a mark are read as without it") {
  const TemporaryFolder folder;
  const auto glove = read_glove_calibration(folder.write("g.txt", mark + "1 2\n1 2\n-1\n"));
  CHECK(glove.slopes(0, 1) == 2);
  CHECK(file_kind(folder.path() / "g.txt") == FileKind::glove_calibration);
}
