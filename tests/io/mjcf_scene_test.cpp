// MJCF scenes as worlds.
#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/io/write/write_mjcf.h"
#include "support/listening.h"
#include "support/meshes.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using namespace clench::test;

namespace {

struct ToldWorld {
  std::vector<std::string> warnings, notes;
  TemporaryFolder folder;
  WorldSpec world;

  explicit ToldWorld(const std::string& in_world, const std::string& beside = "",
                     ReadOptions options = {}) {
    options.diagnostics = Listening{.warn = [this](const std::string& s) { warnings.push_back(s); },
                                    .note = [this](const std::string& s) { notes.push_back(s); }};
    world = read_world(
        folder.write("scene.xml", "<mujoco model='m'><compiler angle='radian'/>" + beside +
                                      "<worldbody>" + in_world + "</worldbody></mujoco>"),
        options);
  }
  bool warned(const std::string& part) const { return ToldRobot::has(warnings, part); }
  bool noted(const std::string& part) const { return ToldRobot::has(notes, part); }
  const PlacedBody& body(const std::string& name) const {
    for (const PlacedBody& placed : world.bodies)
      if (placed.body.name == name) return placed;
    FAIL("no body " << name);
    return world.bodies.at(0);
  }
  double friction(const std::string& a, const std::string& b) const {
    const auto find = [&](const std::string& name) {
      for (const OwnFriction& own : world.frictions)
        if (material_name(own) == name) return own;
      FAIL("no material " << name);
      return OwnFriction{};
    };
    return combined(find(a), find(b));
  }
};

std::string failure(const std::string& in_world, const std::string& beside = "",
                    const ReadOptions& options = {}) {
  try {
    const ToldWorld told(in_world, beside, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::string arm =
    "<body name='arm' pos='0 0 1'><geom size='0.1'/><body name='upper' pos='0 0 0.3'>"
    "<joint name='a' range='-1 1' damping='2' frictionloss='3' armature='4'/><geom size='0.1'/>"
    "</body></body>";
const std::string door =
    "<body name='door' pos='3 0 0'><joint name='hinge' range='0 2'/><geom size='0.1'/></body>";
const std::string mug =
    "<body name='mug' pos='0 2 0'><freejoint/><geom size='0.1' mass='0.5'/></body>";

}  // namespace

TEST_CASE("of a scene trees of joints are robots, free bodies objects, what is fixed obstacles") {
  const ToldWorld told("<geom name='shelf' type='box' size='1 2 3' pos='0 0 -9'/>" + arm + door +
                       mug + "<body name='wall' pos='0 0 -5'><geom size='1'/></body>");
  REQUIRE(told.world.robots.size() == 2);
  CHECK(told.world.robots[0].robot.name == "arm");
  CHECK(told.world.robots[0].X_WB.position.z() == 1);
  CHECK(told.world.robots[0].robot.files.body == "arm");
  // a tree that begins with a joint gets a base frame
  CHECK(told.world.robots[1].robot.base.name == "door_world");
  CHECK(told.world.robots[1].robot.dofs.size() == 1);
  CHECK(told.body("mug").role == Role::object);
  CHECK(told.body("mug").body.mass == 0.5);
  CHECK(told.body("mug").X_WB.position.y() == 2);
  CHECK(told.body("shelf").role == Role::obstacle);
  CHECK(told.body("shelf").X_WB.position.z() == -9);
  CHECK(told.body("shelf").body.shape->bounds().high.z() == 3);
  CHECK(told.body("wall").role == Role::obstacle);
  // in the file's order
  CHECK(told.world.order[0].kind == WorldEntry::Kind::body);
  CHECK(told.world.order[1].kind == WorldEntry::Kind::robot);
}

TEST_CASE("one robot is called as the model is, and a free tree stands where its body does") {
  const ToldWorld told(
      "<body name='hand' pos='0 0 2'><freejoint/><geom size='0.1'/><body>"
      "<joint name='a' range='0 1'/><geom size='0.1' pos='0 0 0.5'/></body></body>");
  REQUIRE(told.world.robots.size() == 1);
  CHECK(told.world.robots[0].robot.name == "m");
  CHECK(told.world.robots[0].X_WB.position.z() == 2);
  CHECK(told.world.robots[0].floating);
}

TEST_CASE("what is fixed to a free body is part of it") {
  const ToldWorld told(
      "<body name='mug'><freejoint/><geom type='box' size='1 1 1' mass='3'/>"
      "<body pos='4 0 0'><geom type='box' size='1 1 1' mass='1'/></body></body>");
  REQUIRE(told.world.bodies.size() == 1);
  const BodySpec& body = told.world.bodies[0].body;
  CHECK(body.mass == 4);
  CHECK(body.com->x() == doctest::Approx(1));
  CHECK(body.shape->bounds().high.x() == doctest::Approx(5));
  // 2/3 of each about its own center, and 3 * 1 + 1 * 9 from there
  CHECK((*body.inertia_per_mass)(1, 1) == doctest::Approx(2.0 / 3 + 12.0 / 4));
}

TEST_CASE("a plane is a large plate below it") {
  const ToldWorld told("<geom name='floor' type='plane' size='0 7 1' pos='0 0 1'/>");
  const PlacedBody& floor = told.body("floor");
  CHECK(floor.X_WB.position.z() == 1);
  CHECK(floor.body.shape->bounds().high.isApprox(Eigen::Vector3d(5, 7, 0)));
  CHECK(floor.body.shape->bounds().low.z() == doctest::Approx(-0.1));
  CHECK(
      told.noted("scene.xml:1: geom: a plane is infinite; a plate of 10 x 14 x 0.1 m replaces it"));
}

TEST_CASE("friction becomes materials that combine as MuJoCo has it") {
  const ToldWorld told(
      "<geom name='a' size='1' friction='0.8'/><geom name='b' size='1' friction='0.5 0.1 0.1'/>"
      "<geom name='c' size='1' friction='0.1' priority='1'/>"
      "<geom name='d' size='1' friction='0.7' condim='1'/><geom name='e' size='1'/>");
  const auto material = [&](const char* name) { return told.body(name).body.material; };
  CHECK(material("a") == "friction 0.8");
  CHECK(material("c") == "friction 0.1 priority 1");
  CHECK(material("d") == "friction 0.7 frictionless");
  CHECK(material("e") == "friction 1");
  CHECK(told.friction(material("a"), material("a")) == 0.8);
  CHECK(told.friction(material("a"), material("b")) == 0.8);
  CHECK(told.friction(material("a"), material("c")) == 0.1);
  CHECK(told.friction(material("d"), material("d")) == 0);
  CHECK(told.friction(material("d"), material("b")) == 0.7);
  CHECK(told.world.frictions.size() == 5);
  const ToldWorld mixed(
      "<body name='x'><geom size='1' friction='0.2'/><geom size='1' friction='2'/>"
      "</body>");
  CHECK(mixed.world.bodies[0].body.material == "friction 2");
  CHECK(
      mixed.warned("scene.xml: bodies whose geoms differ in friction; the one of the highest "
                   "priority, then the largest, is used for all: 'x'"));
  CHECK(failure("<geom size='1' friction='2e6'/>") ==
        "scene.xml:1: geom: friction: expected a number from 0 to 1e+06, got 2000000");
}

TEST_CASE("gravity is that of the file, else that of MuJoCo") {
  CHECK(ToldWorld(mug).world.gravity->z() == -9.81);
  CHECK(ToldWorld(mug, "<option gravity='1 2 3'/>").world.gravity->y() == 2);
  CHECK(ToldWorld(mug, "<option><flag gravity='disable'/></option>").world.gravity->isZero(0));
  CHECK(
      failure(mug, "<option gravity='0 0 2e6'/>") ==
      "scene.xml:1: option: gravity: expected a number from -1e+06 to 1e+06 [m/s^2], got 2000000");
}

TEST_CASE("damping, friction and armature of joints and actuators are kept") {
  const ToldWorld told(arm,
                       "<actuator><position name='p' joint='a' kp='5' kv='0.5' gear='2' "
                       "ctrlrange='-1 1'/><velocity joint='a' kv='3' forcerange='-7 7'/>"
                       "<general joint='a' gainprm='9' biastype='affine' biasprm='1 -2 -3'/>"
                       "<motor joint='a'/><damper joint='a'/><damper joint='a'/></actuator>");
  const RobotSpec& robot = told.world.robots[0].robot;
  const JointSpec& joint = robot.links[0].joints[0];
  CHECK(joint.viscous == 2);
  CHECK(joint.coulomb == 3);
  CHECK(joint.armature == 4);
  REQUIRE(robot.actuators.size() == 6);
  const ActuatorSpec& servo = robot.actuators[0];
  CHECK(servo.name == "p");
  CHECK(servo.joint == "a");
  CHECK(servo.dof == 0);
  CHECK(servo.gear == 2);
  CHECK(servo.gain == 5);
  // sum of the servo, the damper and the general actuator; gears enter squared
  CHECK(robot.dofs[0].kp == 5 * 4 + 2);
  CHECK(robot.dofs[0].kd == 0.5 * 4 + 3 + 3);
  CHECK(servo.bias == std::array{0.0, -5.0, -0.5});
  CHECK(servo.control_range == std::array{-1.0, 1.0});
  CHECK(robot.actuators[1].bias == std::array{0.0, 0.0, -3.0});
  CHECK(robot.actuators[1].force_range == std::array{-7.0, 7.0});
  CHECK(robot.actuators[2].gain == 9);
  CHECK(robot.actuators[2].bias == std::array{1.0, -2.0, -3.0});
  CHECK(robot.actuators[3].kind == "motor");
  CHECK(robot.actuators[4].law_known);
  CHECK(robot.actuators[4].gain == 0);
  CHECK(robot.actuators[4].gain_slopes[1] < 0);
  // one warning per kind
  CHECK(std::ranges::count_if(told.warnings, [](const std::string& s) {
          return s.find(
                     "<damper>: its gain, which depends on length or velocity, affects efforts") !=
                 std::string::npos;
        }) == 1);
}

TEST_CASE("couplings and actuators belong to the robot whose joints they name") {
  const std::string finger =
      "<body name='f'><joint name='p' range='0 1'/><geom size='0.1'/><body>"
      "<joint name='q' range='0 1'/><geom size='0.1'/></body></body>";
  const ToldWorld told(arm + finger,
                       "<equality><joint joint1='q' joint2='p'/><joint joint1='a' joint2='p'/>"
                       "</equality><actuator><motor joint='p'/></actuator>");
  CHECK(told.world.robots[1].robot.dofs.size() == 1);
  CHECK(told.world.robots[0].robot.actuators.empty());
  CHECK(told.world.robots[1].robot.actuators.size() == 1);
  CHECK(told.warned("joint: joint 'a' belongs to another robot; this is not used"));
  CHECK(told.noted("joints that no actuator drives do not close: 'a'"));
  const ToldWorld shared(arm + finger,
                         "<tendon><fixed name='t'><joint joint='a' coef='1'/><joint joint='p' "
                         "coef='1'/></fixed></tendon><actuator><motor tendon='t'/></actuator>");
  CHECK(shared.warned(
      "motor: drives a tendon of two robots; in each robot it moves the joints of that robot"));
}

TEST_CASE("keyframes become named states") {
  const ToldWorld told(
      mug + arm + door + "<body name='m' mocap='true' pos='9 0 0'><geom size='1'/></body>",
      "<keyframe><key name='home' qpos='1 2 3 0 0 0 2 0.5 1.5' mpos='0 0 9'/>"
      "<key qpos='1 2 3 1 0 0 0 0.5 7' ctrl='1'/></keyframe>");
  REQUIRE(told.world.keyframes.size() == 2);
  const KeyframeSpec& home = told.world.keyframes[0];
  CHECK(home.name == "home");
  REQUIRE(home.bodies.size() == 2);
  CHECK(home.bodies[0].X_WB.position == Eigen::Vector3d(1, 2, 3));
  CHECK(home.bodies[0].X_WB.rotation.z() == 1);
  CHECK(home.bodies[1].X_WB.position.z() == 9);
  REQUIRE(home.robots.size() == 2);
  CHECK(home.robots[0].dofs == std::vector{0.5});
  CHECK(home.robots[1].dofs == std::vector{1.5});
  CHECK(told.world.keyframes[1].name == "2");
  CHECK(told.world.keyframes[1].robots[1].dofs == std::vector{2.0});
  CHECK(told.warned("key: qpos: joint 'hinge' is at 7, outside [0, 2]; moved to the limit"));
  CHECK(told.warned("attributes of <key> that are not used, here and further on: ctrl"));
}

TEST_CASE("in keyframes balls are three turns and followers follow") {
  const ToldWorld told(
      "<body name='a'><body name='b'><joint name='ball' type='ball'/><geom size='1'/>"
      "</body><body name='c'><joint name='p' range='0 1'/><geom size='1'/>"
      "<body name='d'><joint name='q' range='0 2'/><geom size='1'/></body></body></body>",
      "<equality><joint joint1='q' joint2='p' polycoef='0 2'/></equality>"
      "<keyframe><key qpos='2 2 0 0 0.5 0.3'/></keyframe>");
  const auto& dofs = told.world.keyframes.at(0).robots.at(0).dofs;
  REQUIRE(dofs.size() == 4);
  CHECK(dofs[0] == doctest::Approx(1.5707963267948966));
  CHECK(dofs[1] == doctest::Approx(0));
  CHECK(dofs[3] == 0.5);
  CHECK(told.warned("joint 'q' follows 'p', and is at 0.3 rather than at 1; it follows"));
}

/// The rotation of a body attached to the base by a ball joint, for the keyframe's values of its
/// three hinges.
static Eigen::Matrix3d ball_rotation(const KeyframeSpec& key, const RobotSpec& robot) {
  const LinkSpec& link = robot.links.at(0);
  REQUIRE(link.joints.size() == 3);
  Pose X;
  for (size_t i = 0; i < 3; ++i)
    X = X * link.joints[i].X_PJ * joint_motion(link.joints[i], key.robots.at(0).dofs.at(i));
  return (X * link.X_JL).rotation.toRotationMatrix();
}

/// All 24 rotations of a cube, including those that turn its middle hinge by a right angle.
static std::vector<Eigen::Quaterniond> cube_rotations() {
  std::vector<Eigen::Quaterniond> out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int signs = 0; i != j && signs < 4; ++signs) {
        Eigen::Matrix3d R;
        R.col(0) = (signs & 1 ? -1 : 1) * Eigen::Vector3d::Unit(i);
        R.col(1) = (signs & 2 ? -1 : 1) * Eigen::Vector3d::Unit(j);
        R.col(2) = R.col(0).cross(R.col(1));
        out.emplace_back(R);
      }
  return out;
}

TEST_CASE("a ball in a keyframe turns its body as its quaternion says, at gimbal lock too") {
  std::vector<Eigen::Quaterniond> turns = cube_rotations();
  REQUIRE(turns.size() == 24);
  // w x y z; as written by people, some far from unit length and near gimbal lock
  for (const auto& q : {std::array{0.5, 0.5, 0.5, 0.5},
                        {0.5, -0.5, 0.5, -0.5},
                        {0.5, 0.5, -0.5, -0.5},
                        {0.65328, 0.2706, 0.65328, 0.2706},
                        {1.0, 1e-9, 1.0, 0.0},
                        {-3.0, 0.0, 3.0, 1e-6}})
    turns.emplace_back(q[0], q[1], q[2], q[3]);
  Random random(31);
  for (int i = 0; i < 500; ++i) turns.push_back(random_turn(random));
  // nearly a right angle about y
  for (int i = 0; i < 200; ++i) {
    const Pose lean = Pose::turn(std::pow(10, -15 * random.uniform()),
                                 random_turn(random) * Eigen::Vector3d::UnitX());
    turns.push_back((lean * Pose::turn(random.uniform(-3, 3), Eigen::Vector3d::UnitX()) *
                     Pose::turn(random.uniform() < 0.5 ? 1.5707963267948966 : -1.5707963267948966,
                                Eigen::Vector3d::UnitY()))
                        .rotation);
  }
  std::string keys;
  for (const auto& q : turns)
    keys += fmt::format("<key qpos='{} {} {} {}'/>", q.w(), q.x(), q.y(), q.z());
  const std::string ball = "<body name='b'><joint type='ball'/><geom size='1'/></body>";
  // a frame turns the body on it, and no joint in the body
  for (const std::string& body :
       {ball, std::string("<body name='b'><frame euler='1 2 3'><joint type='ball'/></frame><geom "
                          "size='1'/></body>")}) {
    const ToldWorld told("<body name='a'><geom size='0.1'/>" + body + "</body>",
                         "<keyframe>" + keys + "</keyframe>");
    REQUIRE(told.world.keyframes.size() == turns.size());
    for (size_t i = 0; i < turns.size(); ++i) {
      const Eigen::Matrix3d off =
          ball_rotation(told.world.keyframes[i], told.world.robots[0].robot) -
          turns[i].normalized().toRotationMatrix();
      CAPTURE(turns[i]);
      CHECK(off.cwiseAbs().maxCoeff() < 1e-9);
    }
    CHECK(!told.warned("outside"));
  }
}

TEST_CASE("an equality of one joint holds it where it says") {
  const std::string held = "<equality><joint joint1='a' polycoef='0.3 0'/></equality>";
  const ToldWorld told(arm, held + "<actuator><position joint='a' ctrlrange='-1 1'/></actuator>");
  const RobotSpec& robot = told.world.robots[0].robot;
  CHECK(robot.links[0].joints[0].min == 0.3);
  CHECK(robot.links[0].joints[0].max == 0.3);
  CHECK(robot.dofs[0].default_value == 0.3);
  CHECK(told.noted("scene.xml:1: joint 'a' is fixed at 0.3 rad because of the equality"));
  CHECK(!told.warned("ctrlrange"));
  // relative to the initial configuration of the model
  const ToldWorld from(
      "<body name='s'><geom size='1'/><body><joint name='a' type='slide' ref='2' range='0 9'/>"
      "<geom size='1'/></body></body>",
      held);
  CHECK(from.world.robots[0].robot.dofs[0].default_value == 2.3);
  CHECK(from.noted("joint 'a' is fixed at 2.3 m because of the equality"));
}

TEST_CASE("of negative gains the magnitude is used, with a warning") {
  const ToldWorld told(
      arm,
      "<actuator><position joint='a' kp='-10' kv='-1'/><velocity joint='a' kv='-2'/></actuator>");
  CHECK(told.warned("position: kp: -10 is negative; 10 is used"));
  const RobotSpec& robot = told.world.robots[0].robot;
  CHECK(robot.actuators[0].gain == 10);
  CHECK(robot.dofs[0].kp == 10);
  CHECK(robot.dofs[0].kd == 1 + 2);
  CHECK(ToldWorld(arm, "<actuator><velocity joint='a' kv='-2'/></actuator>")
            .warned("velocity: kv: -2 is negative; 2 is used"));
}

TEST_CASE("keyframes that do not fit are refused, or told where bodies are missing") {
  CHECK(failure(arm, "<keyframe><key qpos='1 2'/></keyframe>") ==
        "scene.xml:1: key: qpos: expected 1 numbers, got 2");
  CHECK(failure(mug, "<keyframe><key qpos='0 0 0 0 0 0 0'/></keyframe>") ==
        "scene.xml:1: key: qpos: expected a quaternion, got zeros");
  const ToldWorld lossy(arm + "<composite/>", "<keyframe><key name='k' qpos='1 2'/></keyframe>");
  CHECK(lossy.world.keyframes.empty());
  CHECK(lossy.warned("<composite> is not used: the world lacks the bodies that it generates"));
  CHECK(
      lossy.warned("key: qpos: keyframe 'k' has 2 numbers, and the bodies that are read take 1; it "
                   "is not used"));
  const ToldWorld twice(arm,
                        "<keyframe><key name='k' qpos='1'/><key name='k' qpos='0'/></keyframe>");
  CHECK(twice.world.keyframes.size() == 1);
  CHECK(twice.warned("key: there is another one of the name 'k'; the first one counts"));
}

TEST_CASE("a scene's bits are kept, and excluded pairs are listed") {
  const ToldWorld told(
      "<geom size='1'/>" + arm + mug +
          "<body name='ghost'><freejoint/><geom size='1' contype='2' conaffinity='2'/></body>",
      "<contact><exclude body1='mug' body2='upper'/><exclude body1='mug' body2='no'/>"
      "<pair geom1='x' geom2='y'/></contact>");
  // the mug with one part of the arm
  CHECK(told.world.never_meet.size() == 1);
  // obstacle, the arm's base and link, mug and ghost
  REQUIRE(told.world.collision_bits.size() == 5);
  int fixed = 0, other = 0;
  for (const auto& [ref, bits] : told.world.collision_bits) {
    fixed += bits.stands;
    other += bits == CollisionBits{.type = 2, .affinity = 2};
  }
  CHECK(fixed == 2);
  CHECK(other == 1);
  CHECK(told.noted("4 pairs of bodies never collide because of contype and conaffinity"));
  CHECK(told.warned("exclude: no body 'no' was read; the exclusion is ignored"));
  CHECK(told.warned("pairs of which a geom is not read are not used: 'x' and 'y'"));
}

TEST_CASE("what a scene holds and a world does not is told, one warning a kind of element") {
  const ToldWorld told("<light/><light/><geom type='hfield' hfield='h'/>" + mug,
                       "<option wind='1 0 0'/><sensor/><visual/>");
  CHECK(told.warned("<light> is not used, nor is another one"));
  CHECK(told.warned("<sensor> is not used"));
  CHECK(told.warned("attributes of <option> that are not used, here and further on: wind"));
  CHECK(told.warned("geom: no obstacle is made of a hfield here; it is not used"));
  CHECK(ToldWorld("<body name='b'><geom type='plane' size='1 1 1'/><geom size='1'/></body>")
            .warned("geom: a plane is no part of a body here; it is not used"));
  // the error names the contents of the file
  CHECK(failure("<geom type='hfield' hfield='h'/>") ==
        "scene.xml: expected bodies or geoms in <worldbody>, got only geoms that are not used, of "
        "type hfield");
  CHECK(failure("<geom type='sdf'/><body><geom type='hfield'/></body>") ==
        "scene.xml: expected bodies or geoms in <worldbody>, got only geoms that are not used, of "
        "type hfield, sdf");
}

TEST_CASE("an empty <worldbody> is an empty world, one of which nothing is read is refused") {
  CHECK(ToldWorld("").world.bodies.empty());
  CHECK(ToldWorld("").warnings.empty());
  CHECK(ToldWorld("", "<option timestep='0.002'/>").world.time_step == 0.002);
  CHECK(ToldWorld("<light/>").warned("<light> is not used"));
  for (const char* lost : {"<body name='a'/>", "<flexcomp name='a'/>"})
    CHECK(failure(lost).ends_with("scene.xml: expected bodies or geoms in <worldbody>, got none"));
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_world(folder.write("none.xml", "<mujoco model='m'/>")),
                       doctest::Contains("expected bodies or geoms in <worldbody>, got none"),
                       Error);
}

TEST_CASE("an empty world comes back from MJCF without a warning") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "empty.xml";
  std::vector<std::string> warnings;
  WorldSpec written;
  written.contact_threshold = 0.0003;
  const auto friction = [](const std::string&, const std::string&) {
    return std::array<double, 2>{1, 1};
  };
  write_mjcf({.world = written, .friction = friction, .name = "empty", .time_step = 0.002}, path);
  const WorldSpec world = read_world(
      path,
      {.diagnostics = Listening{.warn = [&](const std::string& s) { warnings.push_back(s); }}});
  CHECK(world.bodies.empty());
  CHECK(world.robots.empty());
  CHECK(warnings == std::vector<std::string>{});
  CHECK(world.contact_threshold == 0.0003);
  CHECK(world.time_step == 0.002);
}

TEST_CASE("settings of MuJoCo's solver are reported unless they are those that are written here") {
  const auto told = [](const std::string& step, const std::string& geom,
                       const std::string& option) {
    return ToldWorld(mug, "<option timestep='" + step + "' " + option + "/><default><geom " + geom +
                              "/></default><size njmax='9' nuserdata='3'/>");
  };
  const std::string stiff = "margin='0.0002' solref='0.008 1' solimp='0.95 0.99 0.0001'";
  const auto ours = told("0.002", stiff, "cone='elliptic' impratio='10' integrator='implicit'");
  CHECK(ours.warnings.size() == 1);
  CHECK(ours.warned("attributes of <size> that are not used, here and further on: nuserdata"));
  CHECK(ours.world.contact_threshold == 0.0002);
  // stiffness for another time step
  const auto other = told("0.001", stiff, "cone='pyramidal' impratio='1' integrator='RK4'");
  CHECK(other.warned(
      "attributes of <geom> that are not used, here and further on: margin, solimp, solref"));
  CHECK(other.warned(
      "attributes of <option> that are not used, here and further on: cone, impratio, integrator"));
  CHECK(!other.world.contact_threshold);
  CHECK(told("0.002", "margin='1' solref='0.008 1' solimp='0.95 0.99 0.0001'", "")
            .warned("attributes of <geom> that are not used, here and further on: margin, solimp, "
                    "solref"));
}

TEST_CASE("a scene's time step is the world's") {
  CHECK(ToldWorld(mug, "<option timestep='0.002'/>").world.time_step == 0.002);
  CHECK(!ToldWorld(mug).world.time_step);
  CHECK(failure(mug, "<option timestep='0'/>").find("option: timestep: ") != std::string::npos);
  CHECK(failure(mug, "<option timestep='nan'/>").find("option: timestep: ") != std::string::npos);
}

TEST_CASE("an actuator on a tendon gives its gains to the DOF that the tendon's joints share") {
  const std::string fingers =
      "<body name='palm'><geom size='1'/>"
      "<body name='left'><joint name='l' axis='1 0 0' range='0 1'/><geom size='1' mass='1'/></body>"
      "<body name='right'><joint name='r' axis='1 0 0' range='0 1'/><geom size='1' "
      "mass='1'/></body></body>";
  const ToldWorld told(fingers,
                       "<tendon><fixed name='split'><joint joint='l' coef='0.5'/><joint joint='r' "
                       "coef='0.5'/></fixed></tendon>"
                       "<actuator><general tendon='split' gainprm='0.3' biastype='affine' "
                       "biasprm='0 -100 -10' gear='2' "
                       "forcerange='-5 5'/></actuator>");
  const RobotSpec& robot = told.world.robots[0].robot;
  REQUIRE(robot.dofs.size() == 1);
  // the actuator gains 2 (0.5 + 0.5) for a unit of both joints
  CHECK(robot.dofs[0].kp == doctest::Approx(400));
  CHECK(robot.dofs[0].kd == doctest::Approx(40));
  CHECK(robot.dofs[0].max_effort == doctest::Approx(10));
}

TEST_CASE("names that are none are repaired") {
  const ToldWorld told("<geom name='a&#9;b' size='1'/>" + arm,
                       "<keyframe><key name='c&#9;d' qpos='0'/></keyframe>");
  CHECK(told.world.bodies[0].body.name == "a?b");
  CHECK(told.world.keyframes[0].name == "c?d");
  CHECK(told.warned("key: name: expected no control characters, got 'c?d'; it becomes 'c?d'"));
}

TEST_CASE("options of one robot are for files of one robot") {
  CHECK(failure(arm + door, "", {.root = {}, .closing = {{"a", 1}}}) ==
        "scene.xml: close: expected a file of one robot, got 2; world:add_robot with the option "
        "'body' "
        "takes one of them");
  CHECK(ToldWorld(arm + mug, "", {.root = {}, .closing = {{"a", -1}}})
            .world.robots[0]
            .robot.dofs[0]
            .default_velocity == -1);
}

TEST_CASE("one robot of a scene is read by its body") {
  TemporaryFolder folder;
  const auto path = folder.write(
      "scene.xml", "<mujoco model='m'><worldbody>" + arm + door + mug + "</worldbody></mujoco>");
  const RobotSpec robot = read_robot(path, {.root = {}, .body = "door"});
  CHECK(robot.name == "door");
  CHECK(robot.dofs.size() == 1);
  CHECK_THROWS_WITH_AS(read_robot(path, {.root = {}, .body = "mug"}),
                       "scene.xml: body: expected the root of a tree of joints, got 'mug', "
                       "expected one of arm, door",
                       Error);
  CHECK_THROWS_WITH_AS(read_robot("tests/data/two_finger/claw.cfg", {.root = {}, .body = "x"}),
                       "claw.cfg: body: expected a scene of MJCF, got another file", Error);
}

TEST_CASE("the file of a robot or a body is a world with that in it") {
  CHECK(read_world("tests/data/two_finger/claw.cfg").robots.size() == 1);
  CHECK(read_world("models/objects/flask.iv").bodies.size() == 1);
  TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_world(folder.write("a.egr", "")),
                       "a.egr: expected a world, a robot or a body, got eigengrasps", Error);
}
