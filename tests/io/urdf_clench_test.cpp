// The element <clench> of a URDF: errors in it are reported with file and line.
#include "clench/base/error.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using namespace clench::test;

namespace {

ToldRobot with(const std::string& element) {
  TemporaryFolder folder;
  folder.write("set.egr", "");
  return ToldRobot(folder.write(
      "h.urdf",
      "<robot name='h'><link name='palm'/><link name='tip'/><joint name='j' type='revolute'>"
      "<parent link='palm'/><child link='tip'/><limit lower='0' upper='1'/></joint>\n" +
          element + "</robot>"));
}

void check_refused(const std::string& inside, const std::string& sentence) {
  INFO(inside);
  CHECK_THROWS_WITH_AS(with("<clench>" + inside + "</clench>"), ("h.urdf:2: " + sentence).c_str(),
                       Error);
}

}  // namespace

TEST_CASE("what <clench> says counts, and nothing is guessed beside it") {
  const ToldRobot told(
      with("<clench><approach xyz='1 2 3' quat='0 1 0 0'/><dof joint='j' velocity='-2' "
           "kind='breakaway' breakaway='3'/><link name='palm' material='rubber'/>"
           "<collision><never link='tip'/><never_pair link1='palm' link2='tip'/>"
           "</collision></clench>"));
  CHECK(told.warnings.empty());
  CHECK(told.robot.dofs[0].default_velocity == -2);
  CHECK(told.robot.dofs[0].kind == DofKind::breakaway);
  CHECK(told.robot.base.material == "rubber");
  CHECK(told.robot.X_BA->position.y() == 2);
  CHECK(told.robot.collision_rules.parts_off == std::vector{0});
  CHECK(!told.noted("these DOFs close it"));
  CHECK(!told.noted("gives no friction"));
}

TEST_CASE("how a hand closes is guessed where <clench> has no word of it") {
  const auto jaws = [](const std::string& element) {
    const auto link = [](const std::string& name, const std::string& size, const std::string& at) {
      const std::string shape =
          "<origin xyz='" + at + "'/><geometry><box size='" + size + "'/></geometry>";
      return "<link name='" + name + "'><collision>" + shape + "</collision></link>";
    };
    const auto joint = [](const std::string& finger, const std::string& axis) {
      return "<joint name='" + finger +
             "_joint' type='prismatic'><parent link='palm'/><child link='" + finger +
             "'/><axis xyz='" + axis + "'/><limit lower='0' upper='0.04'/></joint>";
    };
    TemporaryFolder folder;
    return ToldRobot(folder.write(
        "j.urdf", "<robot name='j'>" + link("palm", "0.1 0.04 0.04", "0 0 -0.02") +
                      link("left", "0.01 0.02 0.06", "0.005 0 0.03") +
                      link("right", "0.01 0.02 0.06", "-0.005 0 0.03") + joint("left", "1 0 0") +
                      joint("right", "-1 0 0") + element + "</robot>"));
  };
  const ToldRobot plain(jaws("")),
      dressed(jaws("<clench><link name='left' material='rubber'/></clench>"));
  CHECK(plain.robot.dofs[0].default_velocity != 0);
  CHECK(dressed.robot.dofs[0].default_velocity == plain.robot.dofs[0].default_velocity);
  REQUIRE(plain.robot.X_BA);
  REQUIRE(dressed.robot.X_BA);
  CHECK(dressed.robot.X_BA->position == plain.robot.X_BA->position);
  CHECK(dressed.robot.links[0].body.material == "rubber");
}

TEST_CASE("the caller's choice comes before that of <clench>") {
  TemporaryFolder folder;
  const auto file = folder.write(
      "h.urdf",
      "<robot name='h'><link name='palm'/><link name='tip'/><joint name='j' type='revolute'>"
      "<parent link='palm'/><child link='tip'/><limit lower='0' upper='1'/></joint>"
      "<clench><dof joint='j' velocity='2'/></clench></robot>");
  ReadOptions options;
  options.closing = {{"j", -1}};
  CHECK(read_robot(file, options).dofs[0].default_velocity == -2);
}

TEST_CASE("what is wrong in <clench> is told by file and line") {
  check_refused("<x/>", "clench: unknown element <x>");
  check_refused("<dofs/>", "clench: unknown element <dofs>; did you mean 'dof'?");
  check_refused("<dof joint='k'/>", "dof: joint: no joint 'k' that leads a DOF");
  check_refused("<dof joint='j' velocty='1'/>",
                "dof: unknown attribute 'velocty'; did you mean 'velocity'?");
  check_refused("<dof joint='j' driven='no'/>", "dof: driven: expected true or false, got 'no'");
  check_refused("<dof joint='j' kind='soft'/>",
                "dof: kind: expected rigid, breakaway or compliant, got 'soft'");
  check_refused("<dof joint='j' breakaway='-1'/>",
                "dof: breakaway: expected a number from 0 to 1e+30, got -1");
  check_refused("<dof joint='j' name=''/>", "dof: name: expected a word, got nothing");
  check_refused("<dof joint='j'/><dof joint='j'/>", "dof: expected one of 'j', got another");
  check_refused("<dof joint='j'><a/></dof>", "dof: expected no elements in it, got <a>");
  check_refused("<dof joint='j'>a</dof>", "dof: expected no text in it, got 'a'");
  check_refused("<joint name='k'/>", "joint: name: no joint 'k'");
  check_refused("<joint name='j' spring='-1'/>",
                "joint: spring: expected a number from 0 to 1e+30, got -1");
  check_refused("<link name='plam'/>", "link: name: no link 'plam'; did you mean 'palm'?");
  check_refused(
      "<link name='palm' material='rubbr'/>",
      "link: material: unknown material 'rubbr', expected one of frictionless, glass, metal, "
      "plastic, wood, rubber, stone; did you mean 'rubber'?");
  check_refused("<approach xyz='0 0 0' quat='1 1 0 0'/>",
                "approach: quat: expected a unit quaternion, w x y z, got (1, 1, 0, 0)");
  check_refused("<approach quat='1 0 0 0'/><approach quat='1 0 0 0'/>",
                "approach: expected one, got another");
  check_refused("<approach quat='1 0 0 0' xyz='0 0 2e9'/>",
                "approach: xyz: expected a position within 1e+09 m of the origin");
  check_refused("<collision><a/></collision>",
                "collision: expected <never>, <never_pair> or <pair>, got <a>");
  check_refused("<joint_tendon><a/></joint_tendon>", "joint_tendon: expected <arm>, got <a>");
  check_refused("<joint_tendon range='2 1'/>", "joint_tendon: range: 2 exceeds 1");
  check_refused("<joint_tendon stiffness='-1'/>",
                "joint_tendon: stiffness: expected a number from 0 to 1e+30, got -1");
  check_refused("<joint_tendon><arm joint='j' length='0'/></joint_tendon>",
                "arm: length: expected a number from 1e-30 to 1e+30, got 0");
  check_refused(
      "<joint_tendon><arm joint='j' length='1'/><arm joint='j' length='1'/></joint_tendon>",
      "arm: joint: expected each joint once");
  check_refused("<collision><never_pair link1='tip' link2='tip'/></collision>",
                "never_pair: link2: expected another link than link1");
  check_refused("<actuator kind='motor' gain='1' bias='1'/>",
                "actuator: bias: expected 3 numbers, got 1");
  check_refused("<actuator kind='motor' force_range='2 1'/>", "actuator: force_range: 2 exceeds 1");
  CHECK_THROWS_WITH_AS(with("<clench/><clench/>"),
                       "h.urdf:2: robot: expected one <clench>, got another", Error);
  CHECK(with("<clench><eigengrasps file='no.egr'/></clench>").warned("h.urdf:2: eigengrasps: "));
}

TEST_CASE("a DOF may have another name than its joint, but not that of another DOF") {
  const auto read = [](const std::string& name) {
    TemporaryFolder folder;
    return ToldRobot(
        folder.write("h.urdf",
                     "<robot name='h'><link name='palm'/><link name='a'/><link name='b'/>"
                     "<joint name='j' type='prismatic'><parent link='palm'/><child link='a'/>"
                     "<limit lower='0' upper='1'/></joint>"
                     "<joint name='k' type='prismatic'><parent link='palm'/><child link='b'/>"
                     "<limit lower='0' upper='1'/></joint>\n<clench><dof joint='j' name='" +
                         name + "'/><dof joint='k' velocity='1'/></clench></robot>"));
  };
  CHECK(read("thumb").robot.dofs[0].name == "thumb");
  CHECK(read("thumb").robot.dofs[1].default_velocity == 1);
  CHECK_THROWS_WITH_AS(read("k"), "h.urdf:2: clench: two DOFs are called 'k'", Error);
}
