// Motors, limits, springs, friction and couplings of joints, compared with closed formulas.
#include <cmath>

#include "clench/base/error.h"
#include "clench/dynamics/control/closing.h"
#include "clench/dynamics/mechanics.h"
#include "clench/model/find.h"
#include "support/pendulums.h"

using namespace clench;
using namespace clench::test;

namespace {

// one rod about a vertical axis, so that gravity has no effect; inertia about its end
struct Arm {
  World world;
  Id<Robot> id;
  double inertia;

  explicit Arm(const DofSpec& dof = {}, const JointSpec& joint = {}) {
    RobotSpec spec = pendulum(1);
    spec.dofs[0] = dof;
    JointSpec& j = spec.links[0].joints[0];
    const Pose X_PJ = j.X_PJ;
    j = joint;
    j.X_PJ = X_PJ;
    j.axis = Eigen::Vector3d::UnitY();
    if (joint.min == 0 && joint.max == 0) j.min = -3, j.max = 3;
    id = world.add_robot(spec, {});
    world.set_gravity({0, 0, 0});
    world.set_collision(false);
    const Body& rod = world.body(world.robot(id).links[0].body);
    inertia = rod.mass * (rod.inertia_per_mass(1, 1) + 0.25);
  }
  double q() const { return world.dofs(id)[0]; }
  double v() const { return world.dof_velocities(id)[0]; }
  DofControl& control() { return world.edit_dynamics().controls[0]; }
};

}  // namespace

TEST_CASE("a motor's spring and damper equal those of the implicit step, up to rounding") {
  Arm arm({.kp = 40, .kd = 3});
  arm.control().target = 0.5;
  double q = 0, v = 0;
  const double h = 1e-3;
  Stepper stepper(arm.world);
  for (int i = 0; i < 500; ++i) {
    // q moves with the old velocity, then I (v' - v) = h (kp (target - q - h v') - kd v')
    q += h * v;
    v = (arm.inertia * v + h * 40 * (0.5 - q)) / (arm.inertia + h * (3 + h * 40));
    stepper.run(h);
    CHECK(std::abs(arm.q() - q) < 1e-9);
    CHECK(std::abs(arm.v() - v) < 1e-9);
  }
}

TEST_CASE("an effort limit holds, and a joint limit stops the joint without bouncing") {
  Arm arm({.max_effort = 2, .kp = 1e6, .kd = 1e3});
  arm.control().target = 3;
  run(arm.world, 0.2);
  CHECK(arm.world.dynamics()->dof_efforts[0] == doctest::Approx(2).epsilon(1e-9));
  CHECK(arm.v() == doctest::Approx(2 / arm.inertia * 0.2).epsilon(1e-9));

  JointSpec joint;
  joint.min = -0.5, joint.max = 0.4;
  Arm limited({}, joint);
  limited.control() = {.mode = ControlMode::effort, .effort = 5, .trajectory = {}};
  run(limited.world, 1);
  CHECK(limited.q() <= 0.4 + 1e-12);
  CHECK(limited.q() > 0.4 - 1e-6);
  CHECK(std::abs(limited.v()) < 1e-9);
}

TEST_CASE(
    "motors without gains reach their target in the period of their natural frequency, without "
    "overshoot") {
  Arm arm;
  arm.control().target = 0.3;
  double highest = 0;
  Stepper stepper(arm.world);
  for (int i = 0; i < 300; ++i) {
    stepper.run(0.001);
    highest = std::max(highest, arm.q());
  }
  CHECK(arm.q() == doctest::Approx(0.3).epsilon(1e-4));
  CHECK(highest < 0.3 + 1e-6);
}

TEST_CASE("a trajectory begins and ends at rest, and has 15/8 of the mean speed in its middle") {
  Arm arm({.kp = 1e5, .kd = 1e3});
  send_dof(arm.world, arm.id, 0, 1.2, 2);
  const double duration = 15.0 / 8 * 1.2 / 2;
  run(arm.world, duration / 2);
  CHECK(arm.q() == doctest::Approx(0.6).epsilon(0.01));
  CHECK(arm.v() == doctest::Approx(2).epsilon(0.01));
  run(arm.world, duration / 2 + 0.1);
  CHECK(arm.q() == doctest::Approx(1.2).epsilon(1e-4));
  CHECK(std::abs(arm.v()) < 1e-3);
}

TEST_CASE("velocity control keeps a velocity, viscous friction damps it, dry friction stops it") {
  Arm arm({.kd = 50});
  arm.control() = {.mode = ControlMode::velocity, .velocity = 0.7, .trajectory = {}};
  run(arm.world, 0.5);
  CHECK(arm.v() == doctest::Approx(0.7).epsilon(1e-6));

  JointSpec viscous;
  viscous.viscous = 0.5;
  Arm slow({}, viscous);
  slow.control().mode = ControlMode::effort;
  slow.world.set_dof_velocities(slow.id, Eigen::VectorXd::Constant(1, 1));
  run(slow.world, 0.4);
  // first order in the step
  CHECK(slow.v() == doctest::Approx(std::exp(-0.5 / slow.inertia * 0.4)).epsilon(1e-3));

  JointSpec dry;
  dry.coulomb = 0.2;
  Arm stops({}, dry);
  stops.control().mode = ControlMode::effort;
  stops.world.set_dof_velocities(stops.id, Eigen::VectorXd::Constant(1, 1));
  const double time = stops.inertia / 0.2;
  run(stops.world, 0.5 * time);
  CHECK(stops.v() == doctest::Approx(0.5).epsilon(1e-2));
  run(stops.world, 0.6 * time);
  CHECK(stops.v() == 0);
  // and dry friction holds against a lower effort
  stops.control().effort = 0.19;
  run(stops.world, 0.1);
  // residual tolerance of a step
  CHECK(std::abs(stops.v()) < 1e-11);
  stops.control().effort = 0.21;
  run(stops.world, 0.1);
  CHECK(stops.v() == doctest::Approx(0.01 * 0.1 / stops.inertia).epsilon(1e-6));
}

TEST_CASE(
    "a joint oscillates by its spring at the root of stiffness over inertia, armature included") {
  JointSpec joint;
  joint.spring = 20;
  joint.rest = 0.1;
  joint.armature = 0.3;
  Arm arm({}, joint);
  arm.control().mode = ControlMode::effort;
  set_step(arm.world, 1e-4);
  const double period = 2 * std::numbers::pi * std::sqrt((arm.inertia + 0.3) / 20);
  run(arm.world, period / 2);
  // from rest at 0 to the other side of 0.1; an implicit spring damps by half a step
  CHECK(arm.q() == doctest::Approx(0.2).epsilon(0.01));
  CHECK(std::abs(arm.v()) < 0.01);
}

TEST_CASE(
    "gravity compensation keeps an arm horizontal, and without it the motor sags by weight over "
    "stiffness") {
  for (const bool compensated : {true, false}) {
    World world;
    RobotSpec spec = pendulum(1);
    spec.dofs[0].kp = 200;
    spec.dofs[0].kd = 20;
    const auto id = world.add_robot(spec, {});
    DynamicSettings settings;
    settings.robots[id] = {.gravity_compensation = compensated, .gains = {}};
    world.set_dynamic_settings(settings);
    world.set_dofs(id, Eigen::VectorXd::Constant(1, std::numbers::pi / 2));
    run(world, 3);
    const double q = world.dofs(id)[0];
    if (compensated) {
      CHECK(std::abs(q - std::numbers::pi / 2) < 1e-12);
    } else {
      // torque about y of a rod at q from the hanging position
      CHECK(200 * (std::numbers::pi / 2 - q) ==
            doctest::Approx(g * 0.5 * std::sin(q)).epsilon(1e-6));
    }
  }
}

TEST_CASE(
    "joints that one DOF drives keep their ratio up to rounding under any load on one of them") {
  World world;
  const auto id = world.add_robot(two_finger(DofKind::rigid, 0.5), {});
  const Robot& robot = world.robot(id);
  close_by_motors(world, id, 1);
  Stepper stepper(world);
  for (int i = 0; i < 200; ++i) {
    world.edit_dynamics().loads[robot.links[1].body.index].force = {0.5 * std::sin(0.1 * i), 0.3,
                                                                    0.2};
    stepper.run(0.001);
  }
  for (size_t j = 0; j < robot.joints.size(); ++j)
    CHECK(world.joints(id)[static_cast<int>(j)] ==
          robot.joints[j].ratio * world.dofs(id)[robot.joints[j].dof]);
}

TEST_CASE(
    "a breakaway finger leaves its blocked joint behind, continues to close, and recouples it when "
    "it opens") {
  World world;
  world.set_gravity({0, 0, 0});
  RobotSpec spec = two_finger(DofKind::breakaway, 0.5);
  for (DofSpec& dof : spec.dofs)
    dof.breakaway_torque = 0.05, dof.max_effort = 0.5, dof.kp = 20, dof.kd = 0.5;
  const auto id = world.add_robot(spec, {});
  DynamicSettings settings;
  settings.robots[id] = {.gains = {}, .breakaway = true};
  world.set_dynamic_settings(settings);
  // the other finger would collide with the wall
  for (const int l : {2, 3}) world.set_collision(false, world.robot(id).links[l].body);
  // a wall in front of the first link of the right finger only
  const Eigen::Vector3d at =
      world.pose(world.robot(id).links[0].body) * Eigen::Vector3d(-0.025, 0, 0);
  world.add_body(body_spec("wall", box(0.01, 0.01, 0.01)), BodyKind::obstacle,
                 Pose::translation(at + Eigen::Vector3d(-0.02, 0, 0)), "wall");
  close_by_motors(world, id, 1);
  run(world, 2.5);
  CHECK(!world.follows_dof(id, 0));
  CHECK(world.follows_dof(id, 1));
  CHECK(world.dofs(id)[0] > world.joints(id)[0] + 0.1);
  CHECK(world.dynamics()->report.overlaps == 0);
  close_by_motors(world, id, -1);
  run(world, 3);
  CHECK(world.follows_dof(id, 0));
  CHECK(world.joints(id)[0] == doctest::Approx(world.dofs(id)[0]));
}

TEST_CASE(
    "the joints of a compliant DOF share their tendon's force according to their springs and yield "
    "to contacts") {
  World world;
  world.set_gravity({0, 0, 0});
  RobotSpec spec = two_finger(DofKind::compliant, 0.5);
  for (LinkSpec& link : spec.links) link.joints[0].spring = 0.5, link.joints[0].viscous = 0.002;
  for (DofSpec& dof : spec.dofs) dof.max_effort = 0.2;
  const auto id = world.add_robot(spec, {});
  world.set_collision(false);  // the fingers would collide
  close_by_motors(world, id, 1);
  run(world, 1);
  // in free air they are at the tendon's position
  const double tendon = world.dofs(id)[0];
  CHECK(tendon > 0.1);
  CHECK(world.joints(id)[0] == doctest::Approx(tendon).epsilon(0.05));
  CHECK(world.joints(id)[1] == doctest::Approx(0.5 * tendon).epsilon(0.05));
}

TEST_CASE("a base with a given motion carries the arm on it, and its jerk acts by inertia") {
  // the arm hangs along -z; its base is jerked along x: the rod's center stays, except for the pull
  // of the hinge
  World world;
  const auto id = add_free_robot(world, pendulum(1));
  world.set_gravity({0, 0, 0});
  world.set_twist(world.robot(id).base, {{1, 0, 0}, {0, 0, 0}});
  Stepper stepper(world);
  stepper.solve(1e-6);
  const Body& rod = world.body(world.robot(id).links[0].body);
  const double inertia = rod.inertia_per_mass(1, 1) + 0.25;
  // angular momentum about the hinge: I w = m l/2 v, in the sense that leaves the center behind
  CHECK(std::abs(world.dof_velocities(id)[0]) == doctest::Approx(0.5 / inertia).epsilon(1e-9));
  CHECK(world.twist(world.robot(id).links[0].body).linear.x() ==
        doctest::Approx(1 - 0.25 / inertia).epsilon(1e-9));
  stepper.run(0.1);
  CHECK(world.pose(world.robot(id).base).position.x() == doctest::Approx(0.1).epsilon(1e-9));
}

TEST_CASE("the sum of a motor's given effort and its controller's effort is limited and reported") {
  Arm arm({.max_effort = 2, .kp = 1e6, .kd = 1e3});
  arm.control() = {.target = 3, .effort = 1.5, .trajectory = {}};
  run(arm.world, 0.1);
  CHECK(arm.v() == doctest::Approx(2 / arm.inertia * 0.1).epsilon(1e-9));
  CHECK(arm.world.dynamics()->dof_efforts[0] == doctest::Approx(2).epsilon(1e-9));
  arm.control() = {.mode = ControlMode::effort, .effort = -0.7, .trajectory = {}};
  run(arm.world, 0.001);
  CHECK(arm.world.dynamics()->dof_efforts[0] == -0.7);
}

TEST_CASE("a joint outside its limits returns slowly") {
  JointSpec joint;
  joint.min = -0.5, joint.max = 0.4;
  Arm arm({}, joint);
  arm.control().mode = ControlMode::effort;
  arm.world.set_dofs_unchecked(arm.id, Eigen::VectorXd::Constant(1, 0.6), {});
  double fastest = 0;
  Stepper stepper(arm.world);
  for (int i = 0; i < 500; ++i) {
    stepper.run(0.001);
    fastest = std::max(fastest, std::abs(arm.v()));
  }
  CHECK(fastest <= 1 + 1e-9);
  CHECK(arm.q() <= 0.4 + 1e-6);
}
