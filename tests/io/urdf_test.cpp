// Robots from URDF as specs.
#include "clench/io/urdf/urdf.h"

#include <fmt/format.h>

#include <numbers>

#include "clench/base/text.h"
#include "support/chains.h"
#include "support/shared.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::ToldRobot;
namespace fs = std::filesystem;

namespace {

using std::numbers::pi;

ReadOptions with_package() {
  ReadOptions options;
  options.packages["gripper_description"] = "tests/data/urdf";
  return options;
}

const fs::path gripper_file = "tests/data/urdf/gripper.urdf";

/// A URDF of two links and the given text between them.
std::string two_links(const std::string& first, const std::string& joint = "type='fixed'",
                      const std::string& inside = "") {
  return "<robot name='r'><link name='a'>" + first + "</link><link name='b'/><joint name='j' " +
         joint + "><parent link='a'/><child link='b'/>" + inside + "</joint></robot>";
}

}  // namespace

TEST_CASE("a URDF keeps the names of its links, joints and DOFs") {
  const ToldRobot gripper(gripper_file, with_package());
  CHECK(gripper.robot.name == "gripper");
  CHECK(gripper.robot.base.name == "gripper_mount");
  CHECK_FALSE(gripper.robot.base.shape);
  REQUIRE(gripper.robot.dofs.size() == 1);
  CHECK(gripper.robot.dofs[0].name == "left_slide");
  for (const auto* name : {"palm", "left_finger", "right_finger", "camera"}) gripper.link(name);
  CHECK(gripper.link("palm").joints.empty());
  CHECK(gripper.link("left_finger").joints.at(0).kind == JointKind::prismatic);
}

TEST_CASE("limits, effort, velocity and friction of a URDF joint are kept") {
  const ToldRobot gripper(gripper_file, with_package());
  const JointSpec& joint = gripper.joint("left_slide");
  CHECK(joint.kind == JointKind::prismatic);
  CHECK(joint.min == 0);
  CHECK(joint.max == 0.05);
  CHECK(joint.viscous == 2);
  CHECK(joint.coulomb == 0.5);
  CHECK(gripper.robot.dofs[0].max_effort == 40);
  CHECK(gripper.robot.dofs[0].max_velocity == 0.1);
}

TEST_CASE("a body collides with all its collision shapes and shows the visual ones") {
  const ToldRobot gripper(gripper_file, with_package());
  const BodySpec& palm = gripper.link("palm").body;
  // a box collides, a cylinder is drawn
  CHECK(palm.shape->solid().volume == doctest::Approx(0.14 * 0.05 * 0.04));
  REQUIRE(palm.appearance.visual);
  CHECK(palm.appearance.visual->bounds().high.x() == doctest::Approx(0.035));
  CHECK(palm.appearance.given);
  CHECK(palm.appearance.color.z() == doctest::Approx(0.6));
  // a box and a ball, one surface
  const BodySpec& finger = gripper.link("left_finger").body;
  CHECK(finger.shape->parts().size() == 2);
  CHECK(finger.shape->bounds().high.z() == doctest::Approx(0.07));
  CHECK_FALSE(finger.appearance.visual);
}

TEST_CASE("a mirrored mesh still faces outward") {
  const ToldRobot gripper(gripper_file, with_package());
  const ShapePtr shape = gripper.link("right_finger").body.shape;
  CHECK(shape->closed());
  CHECK(shape->solid().volume == doctest::Approx(0.008 * 0.02 * 0.06));
}

TEST_CASE("an inertia is turned into the frame of its link") {
  const ToldRobot gripper(gripper_file, with_package());
  const BodySpec& palm = gripper.link("palm").body;
  CHECK(palm.mass == 0.5);
  REQUIRE(palm.com);
  CHECK(palm.com->z() == 0.02);
  REQUIRE(palm.inertia_per_mass);
  // a quarter turn about z exchanges the moments about x and y
  CHECK((*palm.inertia_per_mass)(0, 0) == doctest::Approx(2e-4 / 0.5));
  CHECK((*palm.inertia_per_mass)(1, 1) == doctest::Approx(4e-4 / 0.5));
}

TEST_CASE("links without a mass weigh what water of their volume does, which is told") {
  const ToldRobot gripper(gripper_file, with_package());
  CHECK(gripper.link("right_finger").body.mass == doctest::Approx(1000 * 0.008 * 0.02 * 0.06));
  CHECK(gripper.noted("get the mass of their volume of water: 'left_finger', 'right_finger'"));
}

TEST_CASE("elements that are not used are told once for each kind") {
  const ToldRobot gripper(gripper_file, with_package());
  CHECK(gripper.warned("<gazebo> is not used, nor is another one"));
  CHECK(gripper.warned("<transmission> is not used"));
  CHECK(gripper.warnings.size() == 2);
}

TEST_CASE("of elements of thousands of names a hundred are told and the rest together") {
  TemporaryFolder folder;
  std::string text = "<robot name='r'><link name='a'/>";
  for (int i = 0; i < 20'000; ++i) text += fmt::format("<k{}/>", i);
  const ToldRobot robot(folder.write("r.urdf", text + "</robot>"), {});
  CHECK(robot.warned("<k99> is not used"));
  CHECK(robot.warned("from here on, 19900 elements of other names are not used"));
  CHECK(robot.warnings.size() == 101);
}

TEST_CASE("a joint that mimics is of its leader's DOF, its offset a constant part") {
  TemporaryFolder folder;
  const auto file =
      folder.write("a.urdf", R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="lead" type="revolute"><parent link="a"/><child link="b"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
<joint name="next" type="revolute"><parent link="b"/><child link="c"/><limit lower="-1" upper="3" effort="1" velocity="1"/>
<mimic joint="lead" multiplier="2" offset="0.5"/></joint></robot>)");
  const ToldRobot told(file);
  REQUIRE(told.robot.dofs.size() == 1);
  const JointSpec& next = told.joint("next");
  CHECK(next.dof == 0);
  CHECK(next.ratio == 2);
  CHECK(test::constant_turn(next) == doctest::Approx(0.5));
  CHECK(next.min == -1.5);
  CHECK(next.max == 2.5);
  const auto [low, high] = dof_range(told.robot, 0);
  CHECK(low == 0);
  CHECK(high == 1);
  CHECK(told.warnings.empty());
}

TEST_CASE("limits of a follower that would hold its leader are not used, which is told") {
  TemporaryFolder folder;
  const auto file =
      folder.write("a.urdf", R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="lead" type="revolute"><parent link="a"/><child link="b"/><limit lower="0" upper="0.8" effort="1" velocity="1"/></joint>
<joint name="next" type="revolute"><parent link="a"/><child link="c"/><limit lower="0" upper="0.8" effort="1" velocity="1"/>
<mimic joint="lead" multiplier="-1"/></joint></robot>)");
  const ToldRobot told(file);
  const auto [low, high] = dof_range(told.robot, 0);
  CHECK(low == 0);
  CHECK(high == doctest::Approx(0.8));
  CHECK(
      told.warned("a.urdf:3: joint 'next' follows 'lead' from -0.8 to 0, and its own limits [0, "
                  "0.8] would stop that; they are not used"));
}

TEST_CASE("a follower of a follower follows the first") {
  TemporaryFolder folder;
  const auto file = folder.write(
      "a.urdf", R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="third" type="continuous"><parent link="c"/><child link="d"/><mimic joint="second" multiplier="2" offset="1"/></joint>
<joint name="second" type="continuous"><parent link="b"/><child link="c"/><mimic joint="first" multiplier="3" offset="0.25"/></joint>
<joint name="first" type="continuous"><parent link="a"/><child link="b"/></joint></robot>)");
  const ToldRobot told(file);
  REQUIRE(told.robot.dofs.size() == 1);
  CHECK(told.joint("third").ratio == 6);
  CHECK(test::constant_turn(told.joint("third")) == doctest::Approx(1.5));
}

TEST_CASE("a follower that does not follow stays at its offset") {
  TemporaryFolder folder;
  const auto file =
      folder.write("a.urdf", R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="lead" type="continuous"><parent link="a"/><child link="b"/></joint>
<joint name="stays" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/>
<mimic joint="lead" multiplier="0" offset="0.5"/></joint></robot>)");
  const ToldRobot told(file);
  CHECK(joints_of(told.robot).size() == 1);
  CHECK(told.link("c").X_JL.angle() == doctest::Approx(0.5));
  CHECK(told.warned("joint 'stays': its multiplier is 0; it stays at 0.5"));
}

TEST_CASE("planners try joints without limits a full turn or a meter either way, which is told") {
  TemporaryFolder folder;
  const ToldRobot turns(folder.write("a.urdf", two_links("", "type='continuous'")));
  CHECK(turns.joint("j").max == doctest::Approx(2 * pi));
  CHECK(turns.noted(
      "joint 'j' turns without end; planners try values up to 6.283 rad from where it is"));
  const ToldRobot slides(folder.write("a.urdf", two_links("", "type='prismatic'")));
  CHECK(slides.joint("j").min == -1);
  CHECK(slides.noted("joint 'j' has no limits; planners try values up to 1 m from where it is"));
}

TEST_CASE("floating and planar joints stay, which is told") {
  TemporaryFolder folder;
  for (const std::string type : {"floating", "planar"}) {
    const ToldRobot told(
        folder.write("a.urdf", two_links("", "type='" + type + "'", "<origin xyz='1 2 3'/>")));
    CHECK(told.robot.dofs.empty());
    CHECK(told.robot.links[0].X_JL.position == Eigen::Vector3d(1, 2, 3));
    CHECK(told.warned("joint 'j' is " + type + "; its link stays where the file puts it"));
  }
}

TEST_CASE("where no link has geometry to collide with, that for pictures serves") {
  TemporaryFolder folder;
  const ToldRobot told(folder.write(
      "a.urdf", two_links("<visual><geometry><box size='1 1 1'/></geometry></visual>")));
  CHECK(told.robot.base.shape);
  CHECK_FALSE(told.robot.base.appearance.visual);
  CHECK(told.noted("the visual geometry is used for both"));
}

TEST_CASE("a link with geometry for pictures only collides with nothing, which is told") {
  TemporaryFolder folder;
  const ToldRobot told(folder.write("a.urdf", R"(<robot name="r">
<link name="a"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
<link name="b"><visual><geometry><sphere radius="1"/></geometry></visual></link>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>)"));
  CHECK_FALSE(told.link("b").body.shape);
  CHECK(told.link("b").body.appearance.visual);
  CHECK(told.noted("pictures only collide with nothing: 'b'"));
}

TEST_CASE("a missing mesh for pictures is told, and not drawn") {
  TemporaryFolder folder;
  const ToldRobot told(folder.write(
      "a.urdf", two_links("<visual><geometry><mesh filename='x.stl'/></geometry></visual>")));
  CHECK(told.warned("a.urdf:1: mesh: no such file: x.stl; it is not drawn"));
  CHECK_FALSE(told.robot.base.appearance.visual);
}

TEST_CASE("a wrong inertia is told and does not keep the robot from its work") {
  TemporaryFolder folder;
  const auto inertial = [](const std::string& mass, const std::string& ixx) {
    return two_links("<inertial><mass value='" + mass + "'/><inertia ixx='" + ixx +
                     "' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
                     "<collision><geometry><box size='0.1 0.1 0.1'/></geometry></collision>");
  };
  const ToldRobot negative(folder.write("a.urdf", inertial("1", "-1")));
  CHECK(
      negative.warned("a.urdf:1: inertia that is not positive definite; it is computed from the "
                      "geometry: 'a'"));
  CHECK_FALSE(negative.robot.base.inertia_per_mass);
  CHECK(negative.robot.base.mass == 1);
  const ToldRobot impossible(folder.write("a.urdf", inertial("1", "3")));
  CHECK(impossible.warned("impossible inertia"));
  const ToldRobot weightless(folder.write("a.urdf", inertial("0", "1")));
  CHECK(
      weightless.warned("a.urdf:1: mass: value: expected a number from 1e-12 to 1e+12 [kg], got 0; "
                        "the inertial of link "
                        "'a' is not used"));
  CHECK(weightless.robot.base.mass == doctest::Approx(1));
  const ToldRobot nonsense(folder.write("a.urdf", inertial("1", "nan")));
  CHECK(nonsense.warned("inertia: ixx: expected a number, got 'nan'"));
}

TEST_CASE("a package is found by option, by its name above the file, or by what lies in it") {
  TemporaryFolder folder;
  const std::string obj = read_text("tests/data/urdf/finger.obj");
  const std::string urdf = two_links(
      "<collision><geometry><mesh filename='package://my_hand/meshes/part.obj' scale='0.001 0.001 "
      "0.001'/></geometry></collision>");
  const auto shape = [](const ToldRobot& told) { return told.robot.base.shape->solid().volume; };
  const double volume = 0.008 * 0.02 * 0.06;

  folder.write("elsewhere/part_of/my_hand/meshes/part.obj", obj);
  const auto away = folder.write("away/robot.urdf", urdf);
  CHECK_THROWS_AS(read_robot(away), Error);
  ReadOptions options;
  options.packages["my_hand"] = folder.path() / "elsewhere/part_of/my_hand";
  CHECK(shape(ToldRobot(away, options)) == doctest::Approx(volume));
  options.packages = {{"", folder.path() / "elsewhere/part_of"}};
  CHECK(shape(ToldRobot(away, options)) == doctest::Approx(volume));
  options.packages = {{"", folder.path() / "elsewhere/part_of/my_hand"}};
  CHECK(shape(ToldRobot(away, options)) == doctest::Approx(volume));

  const auto within = folder.write("elsewhere/part_of/my_hand/urdf/robot.urdf", urdf);
  CHECK(shape(ToldRobot(within)) == doctest::Approx(volume));

  folder.write("copied/meshes/part.obj", obj);
  const ToldRobot guessed(folder.write("copied/robot.urdf", urdf));
  CHECK(shape(guessed) == doctest::Approx(volume));
  CHECK(guessed.noted("robot.urdf: package 'my_hand' is taken to be "));
}

TEST_CASE("names count from the folder of the call, too") {
  TemporaryFolder folder;
  const auto file = folder.write("deep/down/a.urdf",
                                 two_links("<collision><geometry><mesh filename='finger.obj' "
                                           "scale='0.001 0.001 0.001'/></geometry></collision>"));
  ReadOptions options;
  options.folder = "tests/data/urdf";
  CHECK(ToldRobot(file, options).robot.base.shape);
}

TEST_CASE("a URDF by another ending is known by what it holds") {
  TemporaryFolder folder;
  CHECK(ToldRobot(folder.write("a.xml", two_links(""))).robot.name == "r");
  CHECK_FALSE(
      looks_like_urdf("<robot type='Hand'><palm>p.xml</palm><chain><link>l.xml</link>"
                      "</chain></robot>"));
}

TEST_CASE("limits of zero width make a DOF that stays") {
  TemporaryFolder folder;
  const ToldRobot told(folder.write(
      "a.urdf", two_links("", "type='revolute'",
                          "<limit lower='0.5' upper='0.5' effort='1' velocity='1'/>")));
  CHECK(dof_range(told.robot, 0)[0] == 0.5);
  CHECK(told.robot.dofs[0].default_velocity == 0);
}

TEST_CASE("a mesh of many meters is told") {
  TemporaryFolder folder;
  folder.write("a.obj",
               "v 0 0 0\nv 20 0 0\nv 0 20 0\nv 0 0 20\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto read = [&](const std::string& scale) {
    const std::string mesh = "<geometry><mesh filename='a.obj'" + scale + "/></geometry>";
    return ToldRobot(folder.write(
        "a.urdf", two_links("<visual>" + mesh + "</visual><collision>" + mesh + "</collision>")));
  };
  const ToldRobot large = read("");
  CHECK(
      large.warned("a.urdf: parts larger than 3 m: 'r_a': is the unit of their geometry right, or "
                   "a scale of 0.001 missing?"));
  CHECK(
      large.warned("a.urdf: parts heavier than a tonne: 'r_a': is the unit of their mass or "
                   "geometry right?"));
  CHECK(large.warnings.size() == 2);
  CHECK(read(" scale='0.001 0.001 0.001'").warnings.empty());
}

TEST_CASE("an open surface without a mass weighs a gram, which is told") {
  TemporaryFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const ToldRobot told(folder.write(
      "a.urdf", two_links("<collision><geometry><mesh filename='a.obj'/></geometry></collision>")));
  CHECK(told.robot.base.mass == 0.001);
  CHECK(
      told.noted("a.urdf:1: links without a mass whose surface is open, and so bounds no volume, "
                 "weigh 0.001 kg: 'a'"));
  CHECK_FALSE(told.noted("volume of water"));
}

TEST_CASE("round shapes weigh what water of their true volume does") {
  TemporaryFolder folder;
  const auto mass = [&](const std::string& element, const std::string& shape) {
    return ToldRobot(folder.write("a.urdf", two_links("<" + element + "><geometry>" + shape +
                                                      "</geometry></" + element + ">")))
        .robot.base.mass;
  };
  const double ball = 4000 * pi / 3 * 1e-3, rod = 1000 * pi * 0.01 * 0.4;
  for (const std::string element : {"collision", "visual"}) {
    CHECK(mass(element, "<sphere radius='0.1'/>") == doctest::Approx(ball));
    CHECK(mass(element, "<cylinder radius='0.1' length='0.4'/>") == doctest::Approx(rod));
    CHECK(mass(element, "<capsule radius='0.1' length='0.4'/>") == doctest::Approx(rod + ball));
  }
}

TEST_CASE("limits of followers that contradict each other are dropped, which is told") {
  TemporaryFolder folder;
  const ToldRobot told(folder.write(
      "a.urdf", R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="k" type="revolute"><parent link="a"/><child link="b"/><limit lower="-1" upper="1"/></joint>
<joint name="m" type="revolute"><parent link="a"/><child link="c"/><limit lower="0.2" upper="1"/><mimic joint="k"/></joint>
<joint name="n" type="revolute"><parent link="a"/><child link="d"/><limit lower="0.2" upper="1"/><mimic joint="k" multiplier="-1"/></joint>
</robot>)"));
  CHECK(
      told.warned("a.urdf:4: joint 'n' follows 'k', and its own limits [0.2, 1] have no value in "
                  "common with those of others that follow it; they are not used"));
  const auto [low, high] = dof_range(told.robot, 0);
  CHECK(low == 0.2);
  CHECK(high == 1);
}

TEST_CASE("a follower of a joint that stands still does not keep the robot from being read") {
  TemporaryFolder folder;
  // 0.3 * 0.7 + 0.1, inverted, is not bit-exactly 0.7
  const ToldRobot told(
      folder.write("a.urdf", R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="k" type="revolute"><parent link="a"/><child link="b"/><limit lower="0.7" upper="0.7"/></joint>
<joint name="m" type="revolute"><parent link="a"/><child link="c"/><limit lower="-1e15" upper="0"/><mimic joint="k" multiplier="0.3" offset="0.1"/></joint>
</robot>)"));
  const auto [low, high] = dof_range(told.robot, 0);
  CHECK(low == 0.7);
  CHECK(high == 0.7);
}

TEST_CASE("of a joint without limits and one that follows it only limits that files give count") {
  const auto pair = [](const char* leads, const char* follows, const char* ratio) {
    TemporaryFolder folder;
    return ToldRobot(folder.write(
        "a.urdf", fmt::format(R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="k" {}<parent link="a"/><child link="b"/></joint>
<joint name="m" {}<parent link="a"/><child link="c"/><mimic joint="k" multiplier="{}"/></joint></robot>)",
                              leads, follows, ratio)));
  };
  const char *endless = "type='continuous'>",
             *none = "type='revolute'><limit lower='-1e15' upper='1e15'/>",
             *limited = "type='revolute'><limit lower='-5' upper='5'/>";
  for (const char* leads : {endless, none}) {
    const ToldRobot both = pair(leads, endless, "100");
    CHECK(both.warnings.empty());
    CHECK(dof_is_endless(both.robot, 0));
    const ToldRobot follower = pair(leads, limited, "1");
    CHECK(follower.warnings.empty());
    CHECK(!dof_is_endless(follower.robot, 0));
    CHECK(dof_range(follower.robot, 0)[1] == 5);
    // limits that would almost stop the leader are treated as a mistake
    const ToldRobot slip = pair(leads, limited, "100");
    CHECK(
        slip.warned("joint 'm' follows 'k' from -628.319 to 628.319, and its own limits [-5, 5] "
                    "would stop that; they are not used"));
    CHECK(dof_is_endless(slip.robot, 0));
  }
  const ToldRobot leader = pair(limited, endless, "100");
  CHECK(leader.warnings.empty());
  CHECK(!dof_is_endless(leader.robot, 0));
  CHECK(dof_range(leader.robot, 0)[1] == 5);
}

TEST_CASE("a mass without an inertia is told as such") {
  TemporaryFolder folder;
  const ToldRobot told(folder.write(
      "a.urdf", two_links("<inertial><mass value='2'/></inertial><collision><geometry><box "
                          "size='0.1 0.1 0.1'/></geometry></collision>")));
  CHECK(told.robot.base.mass == 2);
  CHECK(
      told.noted("a.urdf:1: a mass without an inertia, which is computed from the geometry: "
                 "'a'"));
  CHECK(told.warnings.empty());
}

TEST_CASE("a DOF slides or turns as its leader does, whichever stands first") {
  TemporaryFolder folder;
  const auto read = [&](const std::string& arm) {
    return ToldRobot(
        folder.write("a.urdf", R"(<robot name="r"><link name="a"/><link name="arm"/>
<link name="b"/><link name="c"/><link name="d"/>
<joint name="s" type="prismatic"><parent link="a"/><child link="d"/><limit lower="0" upper="1"/></joint>
<joint name="arm" type="fixed"><parent link="a"/><child link="arm"/></joint>
<joint name="j" type="prismatic"><parent link="arm"/><child link="b"/><limit lower="0" upper="0.03"/><mimic joint="k" multiplier="0.02"/></joint>
<joint name="k" type="revolute"><parent link=")" +
                                   arm + R"("/><child link="c"/><limit lower="0" upper="1"/></joint>
</robot>)"));
  };
  for (const std::string arm : {"a", "arm"}) {
    const ToldRobot told = read(arm);
    REQUIRE(told.robot.dofs.size() == 2);
    std::vector<std::string> joints;
    each_joint(told.robot, [&](const JointSpec& joint) {
      if (joint.dof == told.joint("k").dof) joints.push_back(joint.name);
    });
    CHECK(joints == std::vector<std::string>{"k", "j"});
    // the order of others is unchanged
    CHECK(told.robot.dofs[0].name == "s");
    CHECK(test::joint_of(told.robot, 0, 0).name == "s");
    CHECK(told.joint("j").ratio == 0.02);
  }
  // a leader distal to its follower stays there
  const ToldRobot behind = read("b");
  CHECK(behind.joint("k").ratio == 1);
  CHECK(behind.robot.dofs.size() == 2);
}

TEST_CASE("the left and the right hand of a maker close alike") {
  REQUIRE_SHARED();
  const fs::path folder = test::shared() / "data/hands-urdf";
  ReadOptions options;
  options.packages[""] = folder;
  for (const std::string name : {"allegro_hand/allegro_hand_", "shadow_hand/shadow_hand_"}) {
    const RobotSpec one = read_robot(folder / (name + "left.urdf"), options),
                    other = read_robot(folder / (name + "right.urdf"), options);
    REQUIRE(one.dofs.size() == other.dofs.size());
    for (size_t d = 0; d < one.dofs.size(); ++d) {
      INFO(name << one.dofs[d].name);
      CHECK(one.dofs[d].default_velocity == other.dofs[d].default_velocity);
    }
  }
}
