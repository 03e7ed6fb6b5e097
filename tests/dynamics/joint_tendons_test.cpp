// Joint tendons and resistance to free motion, compared with closed formulas.
#include <cmath>
#include <functional>

#include "clench/base/error.h"
#include "clench/dynamics/mechanics.h"
#include "support/pendulums.h"

using namespace clench;
using namespace clench::test;

namespace {

/// Two rods side by side on one base, about vertical axes, so that gravity has no effect.
struct TendonPair {
  World world;
  Id<Robot> id;
  double inertia;

  explicit TendonPair(const JointTendonSpec& tendon) {
    RobotSpec spec = pendulum(2, {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX()});
    spec.links[1].parent = -1;
    spec.links[1].joints[0].X_PJ = Pose::translation({5, 0, 0});
    for (LinkSpec& link : spec.links) link.joints[0].axis = Eigen::Vector3d::UnitY();
    spec.joint_tendons = {tendon};
    id = add_free_robot(world, spec);
    world.set_gravity({0, 0, 0});
    const Body& rod = world.body(world.robot(id).links[0].body);
    inertia = rod.mass * (rod.inertia_per_mass(1, 1) + 0.25);
  }
  double q(int dof) const { return world.dofs(id)[dof]; }
  double v(int dof) const { return world.dof_velocities(id)[dof]; }
  void start(double a, double b) { world.set_dof_velocities(id, Eigen::Vector2d(a, b)); }
  void push(double a, double b) {
    world.edit_dynamics().controls[0].effort = a;
    world.edit_dynamics().controls[1].effort = b;
  }
};

}  // namespace

TEST_CASE("a tendon's range limits the weighted sum of DOFs, which share its force by their arms") {
  TendonPair pair({.arms = {{0, 1}, {1, -2}}, .range = std::array{-0.1, 0.2}});
  pair.push(3, 0);
  run(pair.world, 1);
  const double length = pair.q(0) - 2 * pair.q(1);
  CHECK(length <= 0.2 + 1e-9);
  CHECK(length > 0.2 - 1e-3);
  // torques 3 - f and 2 f keep the length constant: a = 2 b
  const double f = 3.0 / 5;
  CHECK(pair.v(1) == doctest::Approx(2 * f / pair.inertia * 1).epsilon(0.05));
  CHECK(pair.v(0) == doctest::Approx(2 * pair.v(1)).epsilon(1e-6));
}

TEST_CASE("DOFs oscillate together by a tendon's spring and damper") {
  const double k = 40, d = 0.5;
  TendonPair pair({.arms = {{0, 1}, {1, -1}}, .stiffness = k, .slack = {0.1, 0.1}, .damping = d});
  set_step(pair.world, 1e-4);
  run(pair.world, 0.3);
  // length x from rest: x'' = -(2/I) (k (x - 0.1) + d x')
  const double w2 = 2 * k / pair.inertia, c = d / pair.inertia, w = std::sqrt(w2 - c * c);
  const double x = 0.1 - 0.1 * std::exp(-c * 0.3) * (std::cos(w * 0.3) + c / w * std::sin(w * 0.3));
  CHECK(pair.q(0) - pair.q(1) == doctest::Approx(x).epsilon(2e-3));
  CHECK(pair.q(0) + pair.q(1) == doctest::Approx(0).epsilon(1e-9));
  const MechanicalEnergy energy = mechanical_energy(pair.world);
  CHECK(energy.potential == doctest::Approx(0.5 * k * (x - 0.1) * (x - 0.1)).epsilon(0.02));
}

TEST_CASE(
    "within its slack lengths a tendon's spring exerts no force, and its dry friction stops it") {
  TendonPair slack({.arms = {{0, 1}, {1, 1}}, .stiffness = 40, .slack = {-1, 1}});
  slack.start(0.5, 0.5);
  run(slack.world, 0.5);
  CHECK(slack.v(0) == doctest::Approx(0.5).epsilon(1e-9));
  TendonPair dry({.arms = {{0, 1}, {1, 1}}, .friction = 0.3});
  dry.start(0.5, 0.5);
  run(dry.world, 0.2);
  CHECK(dry.v(0) == doctest::Approx(0.5 - 0.2 * 0.3 / dry.inertia).epsilon(1e-6));
  // motion at constant tendon length is free
  dry.start(0.5, -0.5);
  run(dry.world, 0.2);
  CHECK(dry.v(0) == doctest::Approx(0.5).epsilon(1e-9));
}

TEST_CASE("a tendon with a wrong DOF, arm or range is rejected by name") {
  const auto refused = [](const JointTendonSpec& tendon) {
    RobotSpec spec = pendulum(2);
    spec.joint_tendons = {tendon};
    World world;
    return [=]() mutable { world.add_robot(spec, {}); };
  };
  CHECK_THROWS_WITH_AS(refused({.name = "t", .arms = {{2, 1}}})(),
                       "pendulum: joint tendon 't': expected a DOF from 0 to 1, got 2", Error);
  CHECK_THROWS_WITH_AS(refused({.name = "t", .arms = {{0, 1}, {0, 1}}})(),
                       "pendulum: joint tendon 't': expected each DOF once, got DOF 0 twice",
                       Error);
  CHECK_THROWS_WITH_AS(refused({.name = "t", .arms = {{0, 1}}, .range = std::array{1.0, 0.0}})(),
                       "pendulum: joint tendon 't': length 1 exceeds 0", Error);
}

namespace {

/// A free box, 2 m x 1 m x 1 m, of 3 kg, whose frame's origin may be off its center.
struct Free {
  World world;
  Id<Body> id;

  explicit Free(const std::function<void(BodySpec&)>& change,
                const Eigen::Vector3d& off = {0, 0, 0},
                DynamicsEngine engine = DynamicsEngine::clench) {
    BodySpec spec = body_spec("box", moved(box(2, 1, 1), off));
    spec.mass = 3;
    change(spec);
    id = world.add_body(spec, BodyKind::object, {});
    DynamicSettings settings = world.dynamic_settings();
    settings.engine = engine;
    world.set_dynamic_settings(settings);
  }
  double fallen() const { return -world.pose(id).position.z(); }
};

/// m v' = m g - d v
double damped_fall(double m, double d, double t) {
  return g * m / d * (t - m / d * (1 - std::exp(-d * t / m)));
}

}  // namespace

TEST_CASE("a body with free damping falls as in a viscous fluid, in both engines") {
  for (const auto engine : {DynamicsEngine::clench, DynamicsEngine::ode}) {
    Free free([](BodySpec& b) { b.free_damping = 6; }, {0, 0, 0}, engine);
    run(free.world, 1);
    CHECK(free.fallen() == doctest::Approx(damped_fall(3, 6, 1)).epsilon(2e-3));
  }
}

TEST_CASE("free damping of any strength stops a rotation, and acts at the origin of the frame") {
  Free turning([](BodySpec& b) { b.free_damping = 1e4; });
  turning.world.set_gravity({0, 0, 0});
  turning.world.set_twist(turning.id, {{0, 0, 0}, {0, 0, 5}});
  run(turning.world, 0.05);
  CHECK(turning.world.twist(turning.id).angular.norm() < 1e-3);
  // if the origin is far from the center of mass, a falling body begins to turn
  Free off([](BodySpec& b) { b.free_damping = 6; }, {1, 0, 0});
  run(off.world, 0.1);
  CHECK(off.world.twist(off.id).angular.y() > 0.01);
  CHECK(std::abs(off.world.twist(off.id).angular.x()) < 1e-12);
}

TEST_CASE("free friction holds a body up to its limit, and free armature adds inertia") {
  Free held([](BodySpec& b) { b.free_friction = 3 * g + 0.1; });
  run(held.world, 0.5);
  CHECK(held.fallen() == 0);
  Free slips([](BodySpec& b) { b.free_friction = g; });
  run(slips.world, 0.5);
  CHECK(slips.fallen() == doctest::Approx(0.5 * (g - g / 3) * 0.25).epsilon(3e-3));
  Free heavy([](BodySpec& b) { b.free_armature = 1; });
  run(heavy.world, 0.5);
  CHECK(heavy.fallen() == doctest::Approx(0.5 * g * 3 / 4 * 0.25).epsilon(3e-3));
}

TEST_CASE("gravity compensation takes a part of a body's weight, in both engines") {
  for (const auto engine : {DynamicsEngine::clench, DynamicsEngine::ode}) {
    Free half([](BodySpec& b) { b.gravity_compensation = 0.5; }, {0, 0, 0}, engine);
    run(half.world, 0.5);
    CHECK(half.fallen() == doctest::Approx(0.25 * g * 0.25).epsilon(3e-3));
  }
  // floating links require no motor torques
  RobotSpec spec = pendulum(2);
  for (LinkSpec& link : spec.links) link.body.gravity_compensation = 1;
  World world;
  const auto id = add_free_robot(world, spec);
  world.set_dofs(id, Eigen::Vector2d(1, 0.5));
  for (DofControl& control : world.edit_dynamics().controls) control.mode = ControlMode::effort;
  run(world, 0.2);
  CHECK(world.dofs(id)[0] == doctest::Approx(1).epsilon(1e-9));
  // and motors do not compensate the weight a second time
  World driven;
  const auto held = driven.add_robot(spec, {});
  driven.set_collision(false);
  driven.set_dofs(held, Eigen::Vector2d(1, 0.5));
  run(driven, 0.2);
  CHECK(driven.dofs(held)[0] == doctest::Approx(1).epsilon(1e-9));
}
