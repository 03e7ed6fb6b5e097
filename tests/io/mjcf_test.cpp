// Robots from MJCF as specs.
#include "clench/io/mjcf/mjcf.h"

#include <numbers>

#include "clench/base/error.h"
#include "support/chains.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using namespace clench::test;
using clench::test::TemporaryFolder;
using clench::test::ToldRobot;
namespace fs = std::filesystem;

namespace {

using std::numbers::pi;

/// A model with this text in the body 'b' of its base 'a'.
ToldRobot model(const std::string& in_b, const std::string& beside = "") {
  TemporaryFolder folder;
  return ToldRobot(folder.write("m.xml", "<mujoco model='m'>" + beside +
                                             "<worldbody><body name='a'><body name='b'>" + in_b +
                                             "</body></body></worldbody></mujoco>"));
}

const std::string radian = "<compiler angle='radian'/>";

}  // namespace

TEST_CASE("a model of many elements is read whole") {
  const ToldRobot hand("tests/data/mjcf/hand.mjcf");
  CHECK(hand.robot.name == "small_hand");
  CHECK(hand.robot.base.name == "small_hand_palm");
  CHECK(hand.dofs() ==
        std::vector<std::string>{"index_mcp", "middle_mcp", "thumb_flex", "thumb_swing"});
  // defaults of the class, of its parent, of the body's class, and the element's attributes
  CHECK(hand.joint("index_mcp").coulomb == 0.02);
  CHECK(hand.joint("index_mcp").viscous == 0.05);
  CHECK(hand.joint("thumb_swing").coulomb == 0);
  CHECK(hand.joint("thumb_flex").max == 1.2);
  // the mesh is in millimeters by the scale of its class
  CHECK(hand.body("thumb").shape->solid().volume == doctest::Approx(0.008 * 0.02 * 0.06));
  CHECK(hand.noted("body 'palm' is the base; its pose in the file is not used"));
  CHECK(
      hand.warned("hand.mjcf:12: a geom of the world itself, on no body, is no part of the robot"));
  CHECK(hand.warned("<sensor> is not used"));
  CHECK(hand.joint("index_mcp").armature > 0);
  REQUIRE(hand.robot.actuators.size() == 3);
  CHECK(hand.robot.actuators[0].tendon == "index_tendon");
  CHECK(hand.robot.actuators[0].dof == 0);
}

TEST_CASE("geoms that collide and geoms that are drawn are kept apart") {
  const ToldRobot hand("tests/data/mjcf/hand.mjcf");
  const BodySpec& palm = hand.body("palm");
  CHECK(palm.shape->bounds().high.x() == doctest::Approx(0.04));
  REQUIRE(palm.appearance.visual);
  CHECK(palm.appearance.visual->bounds().high.x() == doctest::Approx(0.038));
  CHECK(palm.appearance.color.x() == doctest::Approx(0.4));
  CHECK(hand.body("index_2").shape->parts().size() == 2);
}

TEST_CASE("an equality ties a joint to another, counted from where both stand at first") {
  const ToldRobot hand("tests/data/mjcf/hand.mjcf");
  const JointSpec& tied = hand.joint("middle_pip");
  CHECK(tied.dof == hand.joint("middle_mcp").dof);
  CHECK(tied.ratio == 0.8);
  CHECK(constant_turn(tied) == doctest::Approx(0.1));
  const ToldRobot from(
      model("<joint name='p' range='-9 9' ref='1'/><joint name='q' range='-9 9' ref='2'/>",
            radian + "<equality><joint joint1='q' joint2='p' polycoef='0.5 3'/></equality>"));
  // q = 2 + 0.5 + 3 (p - 1), and the pose is relative to q = 2
  CHECK(from.joint("q").ratio == 3);
  CHECK(constant_turn(from.joint("q")) == doctest::Approx(-0.5 - 2));
}

TEST_CASE("a motor on a tendon moves its joints together, in proportion") {
  const ToldRobot hand("tests/data/mjcf/hand.mjcf");
  CHECK(hand.joint("index_pip").dof == hand.joint("index_mcp").dof);
  CHECK(hand.joint("index_pip").ratio == 0.5);
  CHECK(
      hand.warned("joints 'index_mcp' and 'index_pip' share a tendon, 'index_tendon', and become "
                  "one DOF; their ratio is assumed to be 1 to 0.5"));
}

TEST_CASE("a tendon of two joints that an equality holds ties them") {
  const ToldRobot told(model(
      "<joint name='p' range='-1 1'/><joint name='q' range='-9 9'/>",
      radian + "<tendon><fixed name='t'><joint joint='p' coef='1'/><joint joint='q' coef='-2'/>"
               "</fixed></tendon><equality><tendon tendon1='t'/></equality>"));
  CHECK(told.joint("q").dof == told.joint("p").dof);
  CHECK(told.joint("q").ratio == 0.5);
}

TEST_CASE("actuators limit their joints and say what drives them") {
  const ToldRobot hand("tests/data/mjcf/hand.mjcf");
  const auto dof = [&](const std::string& name) {
    for (const auto& d : hand.robot.dofs)
      if (d.name == name) return d;
    return DofSpec{};
  };
  CHECK(dof("middle_mcp").max_effort == 3);
  CHECK(dof("middle_mcp").kp == 2);
  CHECK(dof("thumb_flex").max_effort == 2);
  CHECK(hand.joint("middle_mcp").min == 0);
  CHECK(hand.joint("middle_mcp").max == 1.2);
  // no actuator drives the swing, so it does not close
  CHECK(dof("thumb_swing").default_velocity == 0);
  CHECK(hand.noted("joints that no actuator drives do not close: 'thumb_swing'"));
}

TEST_CASE("excluded pairs never collide, nor do pairs whose bits differ") {
  const ToldRobot hand("tests/data/mjcf/hand.mjcf");
  REQUIRE(hand.robot.collision_rules.pairs_off.size() == 1);
  const auto& [a, b] = hand.robot.collision_rules.pairs_off[0];
  CHECK(hand.robot.links[a].body.name == "small_hand_index_1");
  CHECK(hand.robot.links[b].body.name == "small_hand_middle_1");
  TemporaryFolder folder;
  const ToldRobot bits(folder.write("m.xml", R"(<mujoco model="m"><worldbody><body name="a">
<geom size="1" contype="2" conaffinity="1"/><body name="b"><geom size="1" contype="2" conaffinity="1"/></body>
<body name="c"><geom size="1"/></body></body></worldbody></mujoco>)"));
  // a and b share no bit, and both share one with c
  CHECK(bits.robot.collision_rules.pairs_off.size() == 1);
  CHECK(bits.noted("1 pair of links never collides because of contype and conaffinity"));
}

TEST_CASE("angles are degrees unless the compiler says radian") {
  CHECK(model("<joint name='j' range='0 90'/>").joint("j").max == doctest::Approx(pi / 2));
  CHECK(model("<joint name='j' range='0 90'/>", radian).joint("j").max == 90);
  CHECK(model("<joint name='j' type='slide' range='0 90'/>").joint("j").max == 90);
}

TEST_CASE("a joint without a range, or unlimited, goes a full turn either way, which is told") {
  for (const std::string joint :
       {"<joint name='j'/>", "<joint name='j' limited='false' range='0 1'/>"}) {
    const ToldRobot told = model(joint);
    CHECK(told.joint("j").max == doctest::Approx(2 * pi));
    CHECK(told.noted("joint 'j' has no limits"));
  }
}

TEST_CASE("a ball joint becomes three turns, a free one none") {
  const ToldRobot ball = model("<joint name='j' type='ball' range='0 60'/>");
  CHECK(ball.dofs() == std::vector<std::string>{"j_x", "j_y", "j_z"});
  CHECK(ball.joint("j_y").max == doctest::Approx(pi / 3));
  CHECK(ball.noted("joint 'j' is a ball"));
  const ToldRobot free = model("<joint name='j' type='free'/>");
  CHECK(free.robot.dofs.empty());
  CHECK(free.warned("joint 'j' is free; body 'b' stays where the file puts it"));
  TemporaryFolder folder;
  const ToldRobot base(folder.write(
      "m.xml", "<mujoco><worldbody><body name='a'><freejoint/></body></worldbody></mujoco>"));
  CHECK(base.warnings.empty());
}

TEST_CASE("geoms are of the sizes that their types mean") {
  const auto high = [](const std::string& geom) {
    return Eigen::Vector3d(model("<geom " + geom + "/>").body("b").shape->bounds().high);
  };
  const auto near = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    CHECK((a - b).norm() < 1e-12);
  };
  near(high("size='2'"), {2, 2, 2});
  near(high("type='box' size='1 2 3'"), {1, 2, 3});
  near(high("type='capsule' size='1 2'"), {1, 1, 3});
  near(high("type='cylinder' size='1 2'"), {1, 1, 2});
  near(high("type='ellipsoid' size='1 2 3'"), {1, 2, 3});
  near(high("type='capsule' size='1' fromto='0 0 1 0 0 5'"), {1, 1, 6});
  near(high("type='box' size='1 2 3' pos='1 0 0' euler='0 0 90'"), {3, 1, 3});
}

TEST_CASE("a robot without masses weighs what its geoms do") {
  const ToldRobot told = model(
      "<geom type='box' size='0.1 0.1 0.1' density='500'/>"
      "<geom type='box' size='0.1 0.1 0.1' pos='0 0 1' mass='4'/>");
  const BodySpec& body = told.body("b");
  CHECK(body.mass == doctest::Approx(8));
  CHECK(body.com->z() == doctest::Approx(0.5));
  // two cubes of 4 kg, half a meter from the center: m a^2/6 each about their centers, plus m d^2
  CHECK((*body.inertia_per_mass)(0, 0) == doctest::Approx(0.04 / 6 + 0.25));
  CHECK((*body.inertia_per_mass)(2, 2) == doctest::Approx(0.04 / 6));
}

TEST_CASE("points of a mesh without faces mean their hull") {
  const ToldRobot told =
      model("<geom type='mesh' mesh='cube'/>",
            "<asset><mesh name='cube' scale='2 1 1' refpos='1 0 0' vertex='0 0 0 1 0 0 0 1 0 1 1 0 "
            "0 0 1 1 0 1 0 1 1 1 1 1 0.5 0.5 0.5'/></asset>");
  const ShapePtr shape = told.body("b").shape;
  CHECK(shape->closed());
  CHECK(shape->solid().volume == doctest::Approx(2));
  // moved to its reference, then scaled
  CHECK(shape->bounds().low.x() == doctest::Approx(-2));
}

TEST_CASE("the body with the most joints is the robot, things that move freely beside it are not") {
  TemporaryFolder folder;
  const ToldRobot told(folder.write("m.xml", R"(<mujoco model="m"><worldbody>
<body name="ball"><freejoint/><geom size="0.1"/></body>
<body name="hand"><body name="finger"><joint name="j" range="0 1"/></body></body>
</worldbody></mujoco>)"));
  CHECK(told.robot.base.name == "m_hand");
  CHECK(told.warned("m.xml:2: body 'ball' moves separately from the robot; it is not read"));
  // several bodies, or one with joints, are attached to the world's frame
  const ToldRobot two(folder.write("m.xml", R"(<mujoco model="m"><worldbody>
<body name="left" pos="1 0 0"><joint name="j" type="slide" range="0 1"/></body><body name="right"/>
</worldbody></mujoco>)"));
  CHECK(two.robot.base.name == "m_world");
  CHECK(chains_of(two.robot).size() == 2);
}

TEST_CASE("what would close a loop is told and left open") {
  const ToldRobot told =
      model("<joint name='j' range='0 1'/>",
            "<equality><connect body1='a' body2='b' anchor='0 0 0'/></equality>");
  CHECK(told.warned("equality: <connect> would close a loop of bodies; it is left open"));
}

TEST_CASE("meshes are looked for in the folder that the compiler names") {
  TemporaryFolder folder;
  folder.write("assets/a.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto text = [](const std::string& compiler) {
    return "<mujoco><compiler " + compiler +
           "/><asset><mesh file='somewhere/a.obj'/></asset><worldbody><body name='b'><geom "
           "type='mesh' mesh='a'/></body></worldbody></mujoco>";
  };
  CHECK_THROWS_AS(read_robot(folder.write("m.xml", text("meshdir='assets'"))), Error);
  CHECK(
      ToldRobot(folder.write("m.xml", text("meshdir='assets' strippath='true'"))).robot.base.shape);
  CHECK(ToldRobot(folder.write("m.xml", text("assetdir='assets' strippath='true'")))
            .robot.base.shape);
}

TEST_CASE("a motor or tendon of a joint that the robot lacks is told, and the robot read") {
  const ToldRobot ball = model("<joint name='j' type='ball' range='0 30'/>",
                               "<actuator><motor joint='j'/></actuator>");
  CHECK(ball.dofs() == std::vector<std::string>{"j_x", "j_y", "j_z"});
  CHECK(ball.warned(
      "m.xml:1: motor: joint 'j' is a ball, which became three hinges; this is not used"));
  for (const DofSpec& turn : ball.robot.dofs) CHECK_FALSE(turn.driven);
  TemporaryFolder folder;
  const auto read = [&](const std::string& beside, const std::string& rest) {
    return ToldRobot(
        folder.write("m.xml", "<mujoco model='m'><worldbody><body name='a'>" + beside +
                                  "<body name='b'><joint name='p' range='0 30'/><joint "
                                  "name='q' range='0 30'/></body></body>"
                                  "<body><freejoint/><body><joint name='hinge'/></body>"
                                  "</body></worldbody>" +
                                  rest + "</mujoco>"));
  };
  CHECK(read("<freejoint name='root'/>", "<actuator><motor joint='root'/></actuator>")
            .warned(
                "motor: joint 'root' is free, and does not belong to the robot; this is not used"));
  const ToldRobot beside = read("", "<equality><joint joint1='hinge'/></equality>");
  CHECK(beside.dofs().size() == 2);
  CHECK(beside.warned("joint: joint 'hinge' belongs to a body that is not read; this is not used"));
  CHECK(read("", "<equality><joint joint1='p' joint2='hinge'/></equality>").dofs().size() == 2);
  // a tendon that has lost a joint couples no others
  const ToldRobot tendon =
      read("",
           "<tendon><fixed name='t'><joint joint='p' coef='1'/><joint joint='q' "
           "coef='1'/><joint joint='hinge' coef='1'/></fixed></tendon>"
           "<equality><tendon tendon1='t'/></equality>");
  CHECK(tendon.dofs().size() == 2);
  CHECK(tendon.warned("joint: joint 'hinge' belongs to a body that is not read"));
  CHECK(read("<composite/>", "<actuator><motor joint='zj'/></actuator>")
            .warned("motor: joint 'zj' may be of a <composite> or <flexcomp>, which are not read"));
}

TEST_CASE("a range of two zeros means none, as it undoes that of a class") {
  const std::string undone = "<default><joint range='-10 10'/></default>";
  const ToldRobot hinge = model("<joint name='j' range='0 0'/>", undone);
  CHECK(hinge.joint("j").max == doctest::Approx(2 * pi));
  CHECK(hinge.noted("joint 'j' has no limits"));
  CHECK(model("<joint name='j' type='ball' range='0 0'/>").dofs().size() == 3);
  // even if a range alone would be an error
  CHECK(model("<joint name='j' range='0 0'/>", "<compiler autolimits='false'/>").dofs().size() ==
        1);
  const ToldRobot locked = model("<joint name='j' range='0 0' limited='true'/>");
  CHECK(locked.joint("j").max == 0);
  CHECK(locked.noted("m.xml:1: joint 'j' is fixed at 0 rad"));
  const std::string servo = "<actuator><position joint='j' ctrlrange='0 0'";
  CHECK(model("<joint name='j' range='-10 90'/>", servo + "/></actuator>").joint("j").max ==
        doctest::Approx(pi / 2));
  const ToldRobot held =
      model("<joint name='j' range='-10 90'/>", servo + " ctrllimited='true'/></actuator>");
  CHECK(held.joint("j").max == 0);
  CHECK(held.noted("joint 'j' is fixed at 0 because of ctrlrange"));
}

TEST_CASE("an outermost class by another name is the global one, which is told") {
  const ToldRobot told = model("<geom type='box' size='0.1 0.1 0.1'/>",
                               "<default class='robot'><geom density='2000'/></default>");
  CHECK(told.body("b").mass == doctest::Approx(16));
  CHECK(
      told.warned("m.xml:1: default: the outermost class is called main; 'robot' is taken for "
                  "it"));
  // it may have a name
  CHECK(model("<geom class='robot' size='1'/>", "<default class='robot'/><default class='robot'/>")
            .body("b")
            .shape);
}

TEST_CASE("a joint that is tied by nothing stands still, and is suspicious") {
  const ToldRobot told(
      model("<joint name='p' range='-9 9'/><joint name='q' range='-9 9'/>",
            radian + "<equality><joint joint1='q' joint2='p' polycoef='0 0 0 0 0'/></equality>"));
  CHECK(told.warned("m.xml:1: joint 'q': polycoef has no linear part: it does not move with 'p'"));
}

TEST_CASE("of a robot alone keyframes are not used, and what uses them is named") {
  const std::string sentence =
      "m.xml:1: <keyframe> is not used for a robot alone; clench.load takes it with the option "
      "'keyframe'";
  CHECK(model("<joint name='p' range='-9 9'/>", "<keyframe><key qpos='1'/></keyframe>")
            .warned(sentence));
  CHECK(!model("<joint name='p' range='-9 9'/>", "<keyframe/>").warned("<keyframe>"));
}

TEST_CASE("a tendon may be held longer than it is at first") {
  const ToldRobot told =
      model("<joint name='p' range='-1 1' ref='0.5'/><joint name='q' range='-9 9'/>",
            radian +
                "<tendon><fixed name='t'><joint joint='p' coef='1'/><joint joint='q' coef='-2'/>"
                "</fixed></tendon><equality><tendon tendon1='t' polycoef='0.2'/></equality>");
  // p - 0.5 - 2 q = 0.2
  CHECK(told.joint("q").ratio == 0.5);
  CHECK(constant_turn(told.joint("q")) == doctest::Approx(-0.35));
}

TEST_CASE("round geoms weigh what their true solids do") {
  const auto mass = [](const std::string& geom) {
    return model("<geom " + geom + "/>").body("b").mass;
  };
  CHECK(mass("size='0.1'") == doctest::Approx(4000 * pi / 3 * 1e-3));
  CHECK(mass("type='cylinder' size='0.1 0.2'") == doctest::Approx(1000 * pi * 0.01 * 0.4));
  CHECK(mass("type='ellipsoid' size='0.1 0.2 0.3'") == doctest::Approx(4000 * pi / 3 * 6e-3));
  CHECK(mass("type='capsule' size='0.1 0.2'") ==
        doctest::Approx(1000 * pi * 0.01 * 0.4 + 4000 * pi / 3 * 1e-3));
}

TEST_CASE("bodies and geoms that are lost are reported, once per kind") {
  const ToldRobot told = model("<geom size='0.1'/><composite/><composite/><flexcomp/>");
  CHECK(
      told.warned("m.xml:1: <composite> is not used: the robot lacks the bodies that it generates; "
                  "save the model expanded by MuJoCo (1 more alike)"));
  CHECK(told.warned("m.xml:1: <flexcomp> is not used"));
  TemporaryFolder folder;
  CHECK(ToldRobot(folder.write("m.xml",
                               "<mujoco><worldbody><geom size='1'/><geom size='1'/><body name='a'/>"
                               "</worldbody></mujoco>"))
            .warned("m.xml:1: 2 geoms of the world itself, on no body, are no part of the robot"));
}

TEST_CASE("a mesh of many meters is told") {
  const std::string corners = "vertex='0 0 0 20 0 0 0 20 0 0 0 20'";
  const std::string geom = "<geom type='mesh' mesh='c'/>";
  CHECK(
      model(geom, "<asset><mesh name='c' " + corners + "/></asset>")
          .warned("m.xml: parts larger than 3 m: 'm_b': is the unit of their geometry right, or a "
                  "scale of 0.001 missing?"));
  CHECK_FALSE(model(geom, "<asset><mesh name='c' scale='.001 .001 .001' " + corners + "/></asset>")
                  .warned("a scale"));
}

TEST_CASE("a mass without an inertia is told as such") {
  CHECK(model("<inertial mass='1' pos='0 0 0'/><geom size='0.1'/>")
            .noted("m.xml:1: a mass without an inertia, which is computed from the geometry: 'b'"));
}
