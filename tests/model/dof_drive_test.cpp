#include "clench/spec/dof_drive.h"

#include "clench/base/random.h"
#include "clench/model/effort_range.h"
#include "support/robots.h"

using namespace clench;

static constexpr double none = DriveTerm::none;

// one sliding joint of the ratio, from -0.1 to 0.1 m
static RobotSpec slider(const std::vector<ActuatorSpec>& actuators, double max_effort = 0,
                        double ratio = 1) {
  RobotSpec robot;
  robot.name = "slider";
  robot.base = test::body_spec("rail", test::box(0.1, 0.1, 0.1));
  DofSpec dof;
  dof.max_effort = max_effort;
  robot.dofs = {dof};
  LinkSpec link;
  link.body = test::body_spec("carriage", test::box(0.1, 0.1, 0.1));
  link.joints = {
      {.name = "slide", .kind = JointKind::prismatic, .ratio = ratio, .min = -0.1, .max = 0.1}};
  robot.links = {link};
  robot.actuators = actuators;
  return robot;
}

// the drive of a slider
struct Driven {
  DofDrive drive;

  EffortRange at_rest(double q) const { return drive.at_rest(Eigen::VectorXd::Constant(1, q)); }
  EffortRange limits() const { return drive.limits(); }
  bool acts() const { return drive.acts(); }
};

static Driven drive_with(const std::vector<ActuatorSpec>& actuators, double max_effort = 0,
                         double ratio = 1) {
  return {drive_of(slider(actuators, max_effort, ratio), 0)};
}

static ActuatorSpec on_slide(const ActuatorSpec& law) {
  ActuatorSpec out = law;
  out.joint = "slide";
  out.dof = 0;
  return out;
}

TEST_CASE("a motor without actuators exerts its maximal effort in both directions") {
  CHECK(drive_with({}, 3).at_rest(0.05) == EffortRange{-3, 3});
  CHECK(drive_with({}).at_rest(0.05) == EffortRange{-none, none});
  CHECK(drive_with({}).limits() == EffortRange{-none, none});
  CHECK(drive_with({}).acts());
}

TEST_CASE("actuators without force have an empty range") {
  ActuatorSpec gear, gain, servo, damper, range;
  gear.gear = 0;
  gain.gain = 0;
  servo.gain = 0, servo.bias = {0, -0.0, 0};
  damper.kind = "damper", damper.gain = 0, damper.gain_slopes = {0, -5};
  range.control_range = {{0, 0}};
  for (const ActuatorSpec& dead : {gear, gain, servo, damper, range}) {
    World world;
    const auto id = world.add_robot(slider({on_slide(dead)}), {});
    CHECK_FALSE(world.robot(id).dofs[0].driven);
    CHECK(effort_range(world, id, 0).is_zero());
    // but a script may add a motor
    CHECK(effort_limits(world, id, 0) == EffortRange{-none, none});
  }
}

TEST_CASE("a motor pulls in the direction of its gear and of its control") {
  ActuatorSpec motor;
  motor.control_range = {{0, 20}};
  CHECK(drive_with({on_slide(motor)}).at_rest(0) == EffortRange{0, 20});
  motor.gear = -1;
  CHECK(drive_with({on_slide(motor)}).at_rest(0) == EffortRange{-20, 0});
  motor.gear = 3;
  CHECK(drive_with({on_slide(motor)}).at_rest(0) == EffortRange{0, 60});
  CHECK(drive_with({on_slide(motor)}, 0, -0.5).at_rest(0) == EffortRange{-30, 0});
  motor.control_range = {};
  motor.force_range = {{-20, 0.001}};
  CHECK(drive_with({on_slide(motor)}).at_rest(0) == EffortRange{-60, 0.003});
}

TEST_CASE("a servo pulls less as it approaches the end of its control range") {
  ActuatorSpec servo;
  servo.gain = 100, servo.bias = {0, -100, -5};
  servo.control_range = {{0, 0.04}};
  const Driven drive = drive_with({on_slide(servo)});
  CHECK(drive.at_rest(0).high == doctest::Approx(4));
  CHECK(drive.at_rest(0.03).high == doctest::Approx(1));
  CHECK(drive.at_rest(0.03).low == doctest::Approx(-3));
  CHECK(drive.at_rest(0.05).high == doctest::Approx(-1));
  // the control range does not bound the part that a motion adds
  CHECK(drive.limits() == EffortRange{-none, none});
  servo.force_range = {{-2, 1.5}};
  CHECK(drive_with({on_slide(servo)}).at_rest(0) == EffortRange{0, 1.5});
  CHECK(drive_with({on_slide(servo)}).limits() == EffortRange{-2, 1.5});
}

TEST_CASE("actuators with unknown laws are represented by their limits") {
  ActuatorSpec muscle;
  muscle.kind = "muscle", muscle.law_known = false;
  CHECK(drive_with({on_slide(muscle)}).at_rest(0) == EffortRange{-none, none});
  muscle.force_range = {{-8, 0}};
  CHECK(drive_with({on_slide(muscle)}).at_rest(0) == EffortRange{-8, 0});
  muscle.force_range = {{-8, 8}}, muscle.law_range = {{-none, 0}};
  CHECK(drive_with({on_slide(muscle)}).at_rest(0) == EffortRange{-8, 0});
  muscle.gear = -2;
  CHECK(drive_with({on_slide(muscle)}).at_rest(0) == EffortRange{0, 16});
}

TEST_CASE("an actuator on a tendon with unknown joints pulls its DOF") {
  ActuatorSpec tendon;
  tendon.tendon = "split", tendon.dof = 0, tendon.force_range = {{-5, 5}};
  CHECK(drive_with({tendon}, 2).at_rest(0) == EffortRange{-2, 2});
  tendon.force_range = {{-5, 0}};
  CHECK(drive_with({tendon}, 2).at_rest(0) == EffortRange{-2, 0});
  CHECK(drive_with({tendon}).at_rest(0) == EffortRange{-5, 0});
  tendon.gear = -2;
  CHECK(drive_with({tendon}).at_rest(0) == EffortRange{0, 10});
  tendon.force_range = {}, tendon.control_range = {{-1, 3}};
  CHECK(drive_with({tendon}).at_rest(0) == EffortRange{-6, 2});
  tendon.bias = {0, -1, 0};
  CHECK(drive_with({tendon}).at_rest(0) == EffortRange{-6, 2});
  ActuatorSpec no_gear = tendon, no_control = tendon;
  no_gear.gear = 0;
  no_control.bias = {0, 0, 0}, no_control.control_range = {{0, 0}};
  for (const ActuatorSpec& dead : {no_gear, no_control}) {
    World world;
    const auto id = world.add_robot(slider({dead}, 2), {});
    CHECK_FALSE(world.robot(id).dofs[0].driven);
  }
}

TEST_CASE("efforts of several actuators add up, and a limit of the DOF bounds their sum") {
  ActuatorSpec closing, opening;
  closing.control_range = {{0, 20}};
  opening.control_range = {{0, 5}}, opening.gear = -1;
  CHECK(drive_with({on_slide(closing), on_slide(opening)}).at_rest(0) == EffortRange{-5, 20});
  CHECK(drive_with({on_slide(closing), on_slide(closing)}).at_rest(0) == EffortRange{0, 40});
  CHECK(drive_with({on_slide(closing), on_slide(closing)}, 12).at_rest(0) == EffortRange{0, 12});
}

TEST_CASE("a tendon pulls each joint by its coefficient, sign included") {
  RobotSpec robot = slider({});
  robot.dofs.push_back(robot.dofs[0]);
  LinkSpec second = robot.links[0];
  second.body.name = "second";
  second.joints[0].name = "second", second.joints[0].dof = 1, second.joints[0].ratio = 2;
  robot.links.push_back(second);
  ActuatorSpec motor;
  motor.tendon = "split", motor.dof = 0, motor.control_range = {{0, 50}};
  motor.pulls = {{"slide", -1}, {"second", 0.5}};
  robot.actuators = {motor};
  const Eigen::Vector2d q(0.01, 0.02);
  CHECK(drive_of(robot, 0).at_rest(q) == EffortRange{-50, 0});
  CHECK(drive_of(robot, 1).at_rest(q) == EffortRange{0, 50});
  // a servo acts on the length that results from both joints
  robot.actuators[0].gain = 100, robot.actuators[0].bias = {0, -100, 0};
  robot.actuators[0].control_range = {{0.02, 0.02}};
  const double force = 100 * (0.02 - (-0.01 + 0.5 * 2 * 0.02));
  CHECK(drive_of(robot, 0).at_rest(q).high == doctest::Approx(-force));
  CHECK(drive_of(robot, 1).at_rest(q).low == doctest::Approx(force));
  // joints of one DOF that cancel
  robot.links[1].joints[0].dof = 0;
  robot.dofs.pop_back();
  CHECK(drive_of(robot, 0).at_rest(Eigen::VectorXd::Zero(1)).is_zero());
  CHECK_FALSE(drive_of(robot, 0).acts());
}

TEST_CASE("limits of a joint and of a tendon bound sums of forces, separately for each direction") {
  ActuatorSpec motor;
  motor.control_range = {{-20, 20}};
  RobotSpec robot = slider({on_slide(motor), on_slide(motor)});
  robot.links[0].joints[0].effort_range = {{-30, 0.001}};
  const Eigen::VectorXd at_0 = Eigen::VectorXd::Zero(1);
  CHECK(drive_of(robot, 0).at_rest(at_0) == EffortRange{-30, 0.001});
  CHECK(drive_of(robot, 0).limits() == EffortRange{-30, 0.001});
  // of the joint, not of the DOF
  robot.links[0].joints[0].ratio = -2;
  CHECK(drive_of(robot, 0).at_rest(at_0) == EffortRange{-0.002, 60});
  robot.links[0].joints[0].effort_range = {{0, 0}};
  CHECK_FALSE(drive_of(robot, 0).acts());
  robot.links[0].joints[0].effort_range.reset();
  for (ActuatorSpec& actuator : robot.actuators) {
    actuator.joint.clear();
    actuator.tendon = "t", actuator.gear = 3;
    actuator.pulls = {{"slide", 1}};
    actuator.tendon_force_range = {{-10, 25}};
  }
  CHECK(drive_of(robot, 0).at_rest(at_0) == EffortRange{-2 * 3 * 25, 2 * 3 * 10});
}

TEST_CASE(
    "gains that depend on length, and an activation instead of the control, are taken into "
    "account") {
  ActuatorSpec general;
  general.gain = 1, general.gain_slopes = {50, 0}, general.control_range = {{0, 2}};
  CHECK(drive_with({on_slide(general)}).at_rest(0.1) == EffortRange{0, 12});
  CHECK(drive_with({on_slide(general)}).at_rest(-0.1) == EffortRange{-8, 0});
  ActuatorSpec servo;
  servo.gain = 100, servo.bias = {0, -100, 0}, servo.activation_range = {{-0.1, 0}};
  CHECK(drive_with({on_slide(servo)}).at_rest(0).high == 0);
  CHECK(drive_with({on_slide(servo)}).at_rest(0.05).low == doctest::Approx(-15));
  servo.activation_range = {{-none, none}}, servo.control_range = {{-1, 1}};
  CHECK(drive_with({on_slide(servo)}).at_rest(0) == EffortRange{-none, none});
  servo.length_at_0 = 0.2, servo.activation_range = {{0, 0.1}};
  CHECK(drive_with({on_slide(servo)}).at_rest(0).high == doctest::Approx(-10));
  ActuatorSpec off;
  off.enabled = false;
  CHECK_FALSE(drive_with({on_slide(off)}).acts());
  CHECK(is_powerless(off));
  CHECK_FALSE(is_powerless(servo));
}

TEST_CASE("the range at rest covers the efforts of random actuators for all controls") {
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    ActuatorSpec a;
    a.gear = random.uniform(-3, 3);
    a.gain = random.uniform(-50, 50);
    if (random.uniform() < 0.5) a.bias[0] = random.uniform(-5, 5);
    if (random.uniform() < 0.5) a.bias[1] = random.uniform(-50, 50);
    const double c0 = random.uniform(-1, 1), c1 = random.uniform(c0, 2);
    a.control_range = {{c0, c1}};
    if (random.uniform() < 0.5) {
      const double f0 = random.uniform(-20, 5);
      a.force_range = {{f0, random.uniform(f0, 20)}};
    }
    const double ratio = random.uniform(0.5, 2), q = random.uniform(-0.1, 0.1);
    const EffortRange range = drive_with({on_slide(a)}, 0, ratio).at_rest(q);
    double low = none, high = -none;
    for (const double control : {c0, c1, 0.5 * (c0 + c1), random.uniform(c0, c1)}) {
      const double length = a.gear * ratio * q;
      double force = a.gain * control + a.bias[0] + a.bias[1] * length;
      if (a.force_range) force = std::clamp(force, (*a.force_range)[0], (*a.force_range)[1]);
      const double effort = force * a.gear * ratio;
      low = std::min(low, effort), high = std::max(high, effort);
    }
    CHECK(range.low == doctest::Approx(low).epsilon(1e-12));
    CHECK(range.high == doctest::Approx(high).epsilon(1e-12));
  }
}
