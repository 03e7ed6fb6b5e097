// Actuators, tendons and joint dynamics of MJCF, by the rules of MuJoCo 3.
#include "clench/io/mjcf/mjcf.h"
#include "support/listening.h"
#include "temporary.h"
#include "told_robot.h"
#include "written_robot.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::ToldRobot;
using clench::test::written;
using clench::test::WrittenRobot;

namespace {

/// A base that carries joints a, b, c side by side, in radians.
ToldRobot three(const std::string& rest, const std::string& joint = "range='-1 1'") {
  TemporaryFolder folder;
  std::string bodies;
  for (const char* name : {"a", "b", "c"})
    bodies += fmt::format(
        "<body name='{0}' pos='0 0 1'><joint name='{0}' axis='0 1 0' {1}/><geom size='0.1'/>"
        "</body>",
        name, joint);
  return ToldRobot(
      folder.write("m.xml",
                   "<mujoco model='m'><compiler angle='radian'/><worldbody><body name='base'>"
                   "<geom size='0.1'/>" +
                       bodies + "</body></worldbody>" + rest + "</mujoco>"));
}

std::string fixed(const std::string& name, double a, double b, const std::string& more = "") {
  return fmt::format(
      "<fixed name='{}' {}><joint joint='a' coef='{}'/><joint joint='b' coef='{}'/></fixed>", name,
      more, a, b);
}

}  // namespace

TEST_CASE("all shortcuts of a class write into one set of defaults") {
  const ToldRobot told = three(R"(<default><default class='g'>
<general gainprm='50' biasprm='0 -50 -3' biastype='affine' forcerange='-2 2'/></default>
<default class='p'><position kp='40' kv='4' forcerange='-3 3'/></default></default><actuator>
<position class='g' joint='a'/><general class='p' joint='b'/><velocity class='g' kv='7' joint='c'/></actuator>)");
  CHECK(told.dof("a").kp == 50);
  CHECK(told.dof("a").kd == 3);
  CHECK(told.dof("a").max_effort == 2);
  CHECK(told.dof("b").kp == 40);
  CHECK(told.dof("b").kd == 4);
  CHECK(told.dof("b").max_effort == 3);
  CHECK(told.dof("c").kp == 0);
  CHECK(told.dof("c").kd == 7);
  // a motor has none of the gains of its class
  const ToldRobot motor =
      three("<default><position kp='40' kv='4'/></default><actuator><motor joint='a'/></actuator>");
  CHECK(motor.dof("a").kp == 0);
  CHECK(motor.robot.actuators[0].gain == 1);
  CHECK(motor.robot.actuators[0].bias == std::array<double, 3>{0, 0, 0});
}

TEST_CASE("the largest effort is the sum of all actuators, within actuatorfrcrange") {
  const std::string both =
      "<actuator><motor joint='a' gear='2' ctrlrange='-3 3' forcerange='-2 2'/>"
      "<general joint='a' gainprm='4' ctrlrange='-1 1'/>"
      "<position joint='b' kp='100'/><motor joint='c'/></actuator>";
  const ToldRobot told = three(both, "range='-1 1' actuatorfrcrange='-5 4'");
  CHECK(told.dof("a").max_effort == 5);
  CHECK(told.dof("b").max_effort == 5);
  CHECK(told.warnings.empty());
  const ToldRobot free = three(both);
  CHECK(free.dof("a").max_effort == 2 * 2 + 4);
  CHECK(free.dof("b").max_effort == 0);  // unlimited
  CHECK(three(both, "actuatorfrcrange='-5 4' actuatorfrclimited='false'").dof("b").max_effort == 0);
}

TEST_CASE("an actuatorfrcrange of two zeros undoes that of a class, unless it limits") {
  const std::string zeros = "actuatorfrcrange='0 0'", limits = " actuatorfrclimited='true'";
  const std::string motor = "<actuator><motor joint='a' ctrlrange='-3 3'/></actuator>";
  CHECK(three(motor, "range='-1 1' " + zeros).dof("a").max_effort == 3);
  CHECK_FALSE(three(motor, "range='-1 1' " + zeros + limits).dof("a").driven);
  const auto pulled = [&](const std::string& more) {
    return three("<tendon>" + fixed("t", 1, 1, more) +
                 "</tendon><actuator><motor tendon='t' ctrlrange='-3 3'/></actuator>")
        .dof("a");
  };
  CHECK(pulled(zeros).max_effort == 6);
  CHECK_FALSE(pulled(zeros + limits).driven);
}

TEST_CASE("a motor on a fixed joint drives no leader") {
  const ToldRobot told = three(
      "<equality><joint joint1='b' joint2='a' polycoef='0 0'/></equality>"
      "<actuator><motor joint='b' ctrlrange='-3 3'/><motor joint='c'/></actuator>");
  CHECK_FALSE(told.dof("a").driven);
  CHECK(told.dof("c").driven);
}

TEST_CASE("actuators without force drive nothing, with a warning") {
  const ToldRobot told = three(
      "<actuator><motor name='still' joint='a' gear='0'/><position joint='b' kp='0'/>"
      "<motor joint='c' forcerange='0 0' forcelimited='true'/></actuator>");
  for (const DofSpec& dof : told.robot.dofs) CHECK_FALSE(dof.driven);
  CHECK(told.warned("drive nothing: 'still', 'b', 'c'"));
}

TEST_CASE("inheritrange takes the range of controls from that of the target") {
  const ToldRobot told =
      three("<actuator><position joint='a' inheritrange='0.5'/></actuator>", "range='-1 3'");
  CHECK(*told.robot.actuators[0].control_range == std::array<double, 2>{0, 2});
  CHECK(told.joint("a").min == 0);
  CHECK(told.joint("a").max == 2);
  CHECK(told.noted("m.xml: joints whose range ctrlrange narrows: 'a'"));
  CHECK(three("<actuator><position joint='a' inheritrange='1'/></actuator>", "")
            .warned("position: inheritrange: expected a target with a range; not used"));
}

TEST_CASE("dynamics between control and force are not simulated, with a warning") {
  CHECK(three("<actuator><position joint='a' timeconst='0.1'/></actuator>")
            .warned("<position>: its control acts at once: the time constant of its filter is not "
                    "used"));
  CHECK(three("<actuator><muscle joint='a'/></actuator>")
            .warned("<muscle>: the law of its force is not kept"));
  CHECK(three("<actuator><motor name='jet' site='s'/><motor name='foil' site='s'/></actuator>")
            .warned("actuators whose target is a site are not used: 'jet', 'foil'"));
  CHECK(three("<actuator><position joint='a' kv='1' dampratio='1'/></actuator>")
            .warned("expected either kv or dampratio, got both; dampratio is used"));
}

TEST_CASE("tendons that pull joints in two ratios leave them independent") {
  const ToldRobot told = three("<tendon>" + fixed("forward", 0.5, 0.5) + fixed("turn", -0.5, 0.5) +
                               "</tendon><actuator><motor tendon='forward' ctrlrange='-2 2'/>"
                               "<motor tendon='turn' ctrlrange='-4 4'/></actuator>");
  CHECK(told.robot.dofs.size() == 3);
  CHECK(told.dof("a").driven);
  CHECK(told.dof("a").max_effort == 0.5 * 2 + 0.5 * 4);
  CHECK(told.warned("joints 'a', 'b'; tendons 'forward', 'turn'"));
  // coefficients of joints coupled by an equality may cancel
  const ToldRobot cancels = three(
      "<equality><joint joint1='b' joint2='a' polycoef='0 -1'/></equality><tendon>"
      "<fixed name='t'><joint joint='a' coef='1'/><joint joint='b' coef='1'/><joint joint='c' "
      "coef='1'/></fixed></tendon><actuator><motor tendon='t'/><motor joint='a'/></actuator>");
  CHECK(cancels.robot.dofs.size() == 2);
  // a motor on one of the joints has the same effect
  const ToldRobot motor =
      three("<tendon>" + fixed("t", 1, 1) +
            "</tendon><actuator><motor tendon='t'/><motor joint='b'/></actuator>");
  CHECK(motor.robot.dofs.size() == 3);
}

TEST_CASE("two tendons of one ratio couple their joints, with a warning") {
  const ToldRobot told =
      three("<tendon>" + fixed("t", 1, 2) + fixed("u", 2, 4) +
            "</tendon><actuator><motor tendon='t'/><motor tendon='u'/></actuator>");
  CHECK(told.robot.dofs.size() == 2);
  CHECK(told.joint("b").ratio == 2);
  CHECK(
      told.warned("joints 'a' and 'b' share a tendon, 't', and become one DOF; their ratio is "
                  "assumed to be 1 to 2; the range of 'a' narrows from [-1, 1] to [-0.5, 0.5]"));
}

TEST_CASE("a tendon that pulls the other way has the same ratio") {
  const auto dofs = [](double b) {
    return three("<tendon>" + fixed("t", 1, 2) + fixed("u", -2, b) +
                 "</tendon><actuator><motor tendon='t'/><motor tendon='u'/></actuator>")
        .robot.dofs.size();
  };
  CHECK(dofs(-4) == 2);
  CHECK(dofs(4) == 3);
  CHECK(dofs(-4.001) == 3);
}

TEST_CASE("limits, springs and friction of fixed tendons are kept") {
  const ToldRobot told =
      three("<tendon>" +
            fixed("t", 1, -2, "range='-0.1 0.2' stiffness='3' damping='0.5' frictionloss='0.7'") +
            "</tendon>");
  REQUIRE(told.robot.joint_tendons.size() == 1);
  const JointTendonSpec& tendon = told.robot.joint_tendons[0];
  CHECK(tendon.name == "t");
  CHECK(tendon.arms == std::vector<std::pair<int, double>>{{0, 1}, {1, -2}});
  CHECK(*tendon.range == std::array<double, 2>{-0.1, 0.2});
  CHECK(tendon.stiffness == 3);
  CHECK(tendon.slack == std::array<double, 2>{0, 0});
  CHECK(tendon.damping == 0.5);
  CHECK(tendon.friction == 0.7);
  const ToldRobot sprung =
      three("<default><tendon stiffness='1'/></default><tendon>" +
                fixed("t", 1, 1, "springlength='0.1 0.3'") + fixed("u", 1, 1) + "</tendon>",
            "springref='0.4'");
  CHECK(sprung.robot.joint_tendons[0].slack == std::array<double, 2>{0.1, 0.3});
  CHECK(sprung.robot.joint_tendons[1].slack == std::array<double, 2>{0.8, 0.8});
}

TEST_CASE("a tendon of one DOF narrows its range, and says so") {
  const std::string tendon =
      "<tendon><fixed name='t' range='-0.2 0.6'><joint joint='a' coef='2'/>"
      "</fixed></tendon>";
  const ToldRobot told = three(tendon);
  CHECK(told.robot.joint_tendons.empty());
  CHECK(told.joint("a").min == -0.1);
  CHECK(told.joint("a").max == 0.3);
  CHECK(
      told.noted("tendon 't': its range narrows that of joint 'a' from [-1, 1] to [-0.1, 0.3] "
                 "rad"));
  CHECK(three(tendon, "range='0.5 1'")
            .warned("tendon 't': its range has no value in common with that of joint 'a'"));
  // joints coupled by an equality are one DOF
  const ToldRobot tied = three(
      "<equality><joint joint1='b' joint2='a' polycoef='0.1 1'/></equality>"
      "<tendon>" +
      fixed("t", 1, 1, "range='-0.9 0.3'") + "</tendon>");
  CHECK(tied.joint("a").min == doctest::Approx(-0.5));
  CHECK(tied.joint("a").max == doctest::Approx(0.1));
}

TEST_CASE("of polynomial damping and stiffness the linear part is used") {
  const ToldRobot told = three("", "damping='2 0.1' stiffness='3 0 4'");
  CHECK(told.joint("a").viscous == 2);
  CHECK(told.joint("a").spring == 3);
  CHECK(
      told.warned("joint 'a': damping: expected one number, got 2; only the first, the linear "
                  "part, is used"));
  CHECK_FALSE(three("", "damping='2 0 0'").warned("damping"));
}

TEST_CASE("resistance to free motion and compensation of gravity are a body's") {
  TemporaryFolder folder;
  const WorldSpec world = read_world(folder.write("m.xml", R"(<mujoco><default><default class='d'>
<joint damping='2' frictionloss='0.3' armature='0.1'/></default></default><worldbody>
<body name='a' gravcomp='0.5'><joint class='d' type='free'/><geom size='0.1'/></body>
<body name='b'><freejoint/><geom size='0.1'/></body>
<body name='c'><joint type='free' damping='4'/><geom size='0.1'/><body name='d' gravcomp='1'><joint/><geom size='0.1'/>
</body></body></worldbody></mujoco>)"));
  const BodySpec& a = world.bodies[0].body;
  CHECK(a.free_damping == 2);
  CHECK(a.free_friction == 0.3);
  CHECK(a.free_armature == 0.1);
  CHECK(a.gravity_compensation == 0.5);
  CHECK(world.bodies[1].body.free_damping == 0);
  CHECK(world.robots[0].robot.base.free_damping == 4);
  CHECK(world.robots[0].robot.links[0].body.gravity_compensation == 1);
  std::vector<std::string> warnings;
  ReadOptions options;
  options.diagnostics =
      test::Listening{.warn = [&](const std::string& sentence) { warnings.push_back(sentence); }};
  read_world(folder.write("m.xml", R"(<mujoco><worldbody><body name='a'>
<joint type='free' stiffness='1' springdamper='1 1'/><geom name='belt' size='0.1' surfacevel='1 0 0'/></body></worldbody></mujoco>)"),
             options);
  const std::string free = "m.xml:2: free joint of 'a': ";
  CHECK(ToldRobot::has(warnings,
                       free + "springs of free bodies are not supported; stiffness is not used"));
  CHECK(ToldRobot::has(warnings, free + "springdamper is not used"));
  CHECK(ToldRobot::has(warnings, "m.xml:2: geom 'belt': surfacevel is not used"));
}

TEST_CASE("a joint's time constant and damping ratio become spring and damper") {
  TemporaryFolder folder;
  const ToldRobot told(folder.write("m.xml", R"(<mujoco><worldbody><body name='base'><body name='a'>
<joint name='j' type='slide' armature='1' springdamper='0.5 2'/><geom size='0.1' mass='3'/></body></body></worldbody></mujoco>)"));
  CHECK(told.joint("j").spring == doctest::Approx(4));    // 4 / (0.5 2)^2
  CHECK(told.joint("j").viscous == doctest::Approx(16));  // 2 4 / 0.5
}

TEST_CASE("tendons, pairs that collide and compensation of gravity survive a URDF") {
  TemporaryFolder folder;
  const ToldRobot told(
      folder.write("m.xml", R"(<mujoco model='m'><worldbody><body name='base' gravcomp='0.5'>
<geom size='0.1'/><body name='a'><joint name='a' axis='0 1 0' range='-9 9'/><geom size='0.1'/>
<body name='b' gravcomp='1'><joint name='b' axis='0 1 0' range='-9 9'/><geom size='0.1'/></body></body></body></worldbody>
<tendon><fixed name='t' range='-0.1 0.2' stiffness='3' springlength='0.1 0.3' damping='0.5' frictionloss='0.7'>
<joint joint='a' coef='1'/><joint joint='b' coef='-2'/></fixed></tendon></mujoco>)"));
  REQUIRE(told.robot.joint_tendons.size() == 1);
  const JointTendonSpec& was = told.robot.joint_tendons[0];
  const WrittenRobot again = written(told.robot, folder.path() / "m.urdf");
  CHECK(again.warnings.empty());
  REQUIRE(again.robot.joint_tendons.size() == 1);
  const JointTendonSpec& now = again.robot.joint_tendons[0];
  CHECK(now.name == was.name);
  CHECK(now.arms == was.arms);
  CHECK(now.range == was.range);
  CHECK(now.slack == was.slack);
  CHECK(now.stiffness == was.stiffness);
  CHECK(now.damping == was.damping);
  CHECK(now.friction == was.friction);
  CHECK(again.robot.collision_rules.pairs_on == told.robot.collision_rules.pairs_on);
  CHECK(again.robot.base.gravity_compensation == 0.5);
  CHECK(again.robot.links[1].body.gravity_compensation == 1);
}
