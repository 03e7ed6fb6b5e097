#include <cmath>

#include "clench/base/error.h"
#include "clench/dynamics/control/closing.h"
#include "clench/dynamics/mechanics.h"
#include "clench/dynamics/stepper.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

void use(World& world, DynamicsEngine engine) {
  DynamicSettings settings = world.dynamic_settings();
  settings.engine = engine;
  world.set_dynamic_settings(settings);
}

/// Copies of one world, one for each engine.
struct Both {
  explicit Both(const World& world) : ours(world), ode(world) { use(ode, DynamicsEngine::ode); }
  void run(double seconds) {
    Stepper(ours).run(seconds);
    Stepper(ode).run(seconds);
    CHECK(ode.dynamics()->report.failures == 0);
    CHECK(ours.dynamics()->report.failures == 0);
  }
  double apart(Id<Body> id) const {
    return (ours.pose(id).position - ode.pose(id).position).norm();
  }
  double turned(Id<Body> id) const {
    return ours.pose(id).rotation.angularDistance(ode.pose(id).rotation);
  }
  World ours, ode;
};

Id<Body> add_block(World& world, const std::string& name, const Vector3d& size, const Pose& X,
                   double mass, BodyKind kind = BodyKind::object) {
  BodySpec spec = body_spec(name, box(size.x(), size.y(), size.z()));
  spec.mass = mass;
  return world.add_body(spec, kind, X);
}

// a block on a slope, at the gap of bodies at rest
Id<Body> add_slope(World& world, double angle, double mu) {
  world.set_friction("wood", "wood", {mu, mu});
  const Pose turn = Pose::turn(angle, Vector3d::UnitY());
  add_block(world, "slope", {4, 1, 0.1}, turn, 1, BodyKind::obstacle);
  return add_block(world, "block", {0.06, 0.06, 0.04},
                   turn * Pose::translation({-1, 0, 0.07 + 0.25 * world.contact_threshold()}),
                   0.44);
}

/// A serial chain of links that hangs from a base, each link with hinges about y (for several axes:
/// one hinge about each), or with sliders.
RobotSpec chain(int links, const std::vector<Vector3d>& axes,
                JointKind kind = JointKind::revolute) {
  RobotSpec robot;
  robot.name = "chain";
  robot.base = body_spec("chain_base", box(0.02, 0.02, 0.02));
  for (int l = 0; l < links; ++l) {
    LinkSpec link{.body = body_spec("chain_link" + std::to_string(l),
                                    moved(box(0.02, 0.03, 0.1), {0, 0, -0.07}))};
    link.body.mass = 0.2 + 0.1 * l;
    link.parent = l - 1;
    for (size_t k = 0; k < axes.size(); ++k) {
      DofSpec dof;
      const double pi = std::numbers::pi;
      JointSpec joint{.kind = kind,
                      .axis = axes[k],
                      .dof = static_cast<int>(robot.dofs.size()),
                      .min = -pi,
                      .max = pi};
      if (l > 0 && k == 0) joint.X_PJ = Pose::translation({0, 0, -0.14});
      robot.dofs.push_back(dof);
      link.joints.push_back(joint);
    }
    robot.links.push_back(link);
  }
  return robot;
}

/// Adds a robot with free joints that is subject to gravity.
Id<Robot> add_loose(World& world, const RobotSpec& spec) {
  const auto id = world.add_robot(spec, {});
  DynamicSettings settings = world.dynamic_settings();
  settings.robots[id].gravity_compensation = false;
  world.set_dynamic_settings(settings);
  world.set_collision(false);
  for (DofControl& control : world.edit_dynamics().controls) control.mode = ControlMode::effort;
  return id;
}

void check_dofs(Both& both, Id<Robot> id, double seconds, double within) {
  for (int i = 0; i < 4; ++i) {
    both.run(seconds / 4);
    const Eigen::VectorXd a = both.ours.dofs(id), b = both.ode.dofs(id);
    CAPTURE(a.transpose());
    CAPTURE(b.transpose());
    CHECK((a - b).norm() < within);
    CHECK((both.ours.dof_velocities(id) - both.ode.dof_velocities(id)).norm() < 20 * within);
  }
}

}  // namespace

TEST_CASE("ODE: a body falls and tumbles as with Clench's solver") {
  World world;
  const auto body = add_block(world, "block", {0.02, 0.06, 0.1}, Pose::translation({0, 0, 5}), 0.5);
  world.set_twist(body, {{0.3, -0.1, 1}, {0.1, 8, 0.1}});
  Both both(world);
  both.run(0.5);
  // with gravity only: rounding errors
  CHECK(both.apart(body) < 1e-12);
  CHECK(both.turned(body) < 1e-12);
}

TEST_CASE("ODE: loads on bodies and velocities of obstacles act as with Clench's solver") {
  World world;
  world.set_friction("wood", "wood", {0.5, 0.5});
  const auto table = add_block(world, "table", {1, 1, 0.1}, {}, 1, BodyKind::obstacle);
  const auto body = add_block(world, "block", {0.06, 0.06, 0.04},
                              Pose::translation({0, 0, 0.07 + 0.25e-4}), 0.44);
  world.set_twist(table, {{0.1, 0, 0}, {0, 0, 0}});
  Both both(world);
  for (World* w : {&both.ours, &both.ode})
    w->edit_dynamics().loads[body.index] = {{0, 0, -2}, {0, 0, 0.01}};
  both.run(0.3);
  CHECK(both.ode.twist(body).linear.x() == doctest::Approx(0.1).epsilon(1e-6));
  CHECK(both.apart(body) < 1e-4);
  // a belt also moves the bodies on it, in the other direction
  for (World* w : {&both.ours, &both.ode}) {
    DynamicSettings settings = w->dynamic_settings();
    settings.surface_velocities[table] = {-0.3, 0, 0};
    w->set_dynamic_settings(settings);
  }
  both.run(0.3);
  CHECK(both.ode.twist(body).linear.x() == doctest::Approx(-0.2).epsilon(1e-6));
  CHECK(both.apart(body) < 2e-4);
}

TEST_CASE(
    "ODE: a block slides down a slope at the textbook acceleration, and sticks below the friction "
    "angle") {
  const double angle = 30 * std::numbers::pi / 180, limit = std::tan(angle);
  {
    World world;
    const auto block = add_slope(world, angle, 0.95 * limit);
    Both both(world);
    both.run(0.2);
    const Vector3d ours = both.ours.twist(block).linear, ode = both.ode.twist(block).linear;
    both.run(0.3);
    const double book = 9.81 * (std::sin(angle) - 0.95 * limit * std::cos(angle));
    CHECK((both.ours.twist(block).linear - ours).norm() / 0.3 ==
          doctest::Approx(book).epsilon(1e-9));
    // ODE's contacts are slightly compliant
    CHECK((both.ode.twist(block).linear - ode).norm() / 0.3 == doctest::Approx(book).epsilon(1e-5));
  }
  World world;
  const auto block = add_slope(world, angle, 1.05 * limit);
  const Vector3d start = world.pose(block).position;
  Both both(world);
  both.run(0.5);
  CHECK((both.ours.pose(block).position - start).norm() < 1e-6);
  CHECK(both.apart(block) < 1e-6);
  CHECK(both.ode.twist(block).linear.norm() < 1e-8);
}

TEST_CASE("ODE: the contact force of a resting block is its weight with both engines") {
  World world;
  world.set_friction("wood", "wood", {0.5, 0.5});
  add_block(world, "table", {1, 1, 0.1}, {}, 1, BodyKind::obstacle);
  add_block(world, "block", {0.06, 0.06, 0.04}, Pose::translation({0, 0, 0.0701}), 0.44);
  Both both(world);
  both.run(0.3);
  for (const World* w : {&both.ours, &both.ode}) {
    Vector3d force = Vector3d::Zero();
    for (const Manifold& m : w->dynamics()->manifolds)
      for (const ManifoldPoint& p : m.points) force += w->pose(m.a).rotation * p.force;
    CHECK((force - Vector3d(0, 0, 0.44 * 9.81)).norm() < 1e-6);
  }
}

TEST_CASE("ODE: hanging links swing as with Clench's solver") {
  SUBCASE("one hinge") {
    World world;
    const auto id = add_loose(world, chain(1, {Vector3d::UnitY()}));
    world.set_dofs(id, Eigen::VectorXd::Constant(1, 1.2));
    Both both(world);
    // joints of ODE yield by 1e-9 of an impulse
    check_dofs(both, id, 1, 1e-7);
  }
  SUBCASE("three hinges: gyroscopic forces") {
    World world;
    const auto id = add_loose(world, chain(3, {Vector3d::UnitY()}));
    world.set_dofs(id, Eigen::Vector3d(1.2, 0.5, -0.8));
    Both both(world);
    check_dofs(both, id, 0.6, 1e-6);
  }
  SUBCASE("crossed axes, two per link: the body in between weighs 1e-6 of a link") {
    World world;
    const auto id = add_loose(world, chain(2, {Vector3d::UnitY(), Vector3d::UnitX()}));
    world.set_dofs(id, Eigen::Vector4d(1.2, 0.5, -0.8, 0.4));
    Both both(world);
    check_dofs(both, id, 0.5, 1e-4);
  }
  SUBCASE("a slider on a hinge, with limits") {
    World world;
    RobotSpec spec = chain(2, {Vector3d::UnitY()});
    spec.links[1].joints[0].kind = JointKind::prismatic;
    spec.links[1].joints[0].axis = Vector3d::UnitZ();
    spec.links[1].joints[0].min = -0.03;
    spec.links[1].joints[0].max = 0.02;
    spec.links[0].joints[0].max = 1.3;
    spec.links[0].joints[0].min = -0.4;
    const auto id = add_loose(world, spec);
    world.set_dofs(id, Eigen::Vector2d(1.2, 0.01));
    Both both(world);
    check_dofs(both, id, 0.8, 1e-5);
    CHECK(both.ode.dofs(id)[1] >= -0.03);
  }
  SUBCASE("springs, dampers, dry friction and rotors") {
    World world;
    RobotSpec spec = chain(2, {Vector3d::UnitY()});
    JointSpec& joint = spec.links[0].joints[0];
    joint.spring = 0.4, joint.rest = 0.3, joint.viscous = 0.01, joint.armature = 2e-3;
    spec.links[1].joints[0].coulomb = 0.02;
    const auto id = add_loose(world, spec);
    world.set_dofs(id, Eigen::Vector2d(1.2, 0.5));
    Both both(world);
    check_dofs(both, id, 0.8, 1e-6);
  }
}

TEST_CASE("ODE: motors hold and follow targets and apply given efforts") {
  World world;
  RobotSpec spec = chain(2, {Vector3d::UnitY()});
  spec.dofs[0].max_effort = 0.5;
  spec.dofs[1].kp = 5, spec.dofs[1].kd = 0.1;
  const auto id = add_loose(world, spec);
  world.edit_dynamics().controls[0] = {
      .mode = ControlMode::velocity, .velocity = 2, .trajectory = {}};
  send_dof(world, id, 1, -0.7, 1);
  Both both(world);
  check_dofs(both, id, 0.6, 1e-6);
  for (World* w : {&both.ours, &both.ode})
    w->edit_dynamics().controls[0] = {.mode = ControlMode::effort, .effort = 0.3, .trajectory = {}};
  check_dofs(both, id, 0.2, 1e-6);
  CHECK(both.ode.dynamics()->dof_efforts[1] ==
        doctest::Approx(both.ours.dynamics()->dof_efforts[1]).epsilon(1e-3));
}

TEST_CASE("ODE: joints of one DOF keep their ratio, for which ODE has no joint") {
  World world;
  RobotSpec spec = chain(3, {Vector3d::UnitY()});
  for (int l = 1; l < 3; ++l) {
    spec.links[l].joints[0].dof = 0;
    spec.links[l].joints[0].ratio = l == 1 ? 0.5 : -0.3;
  }
  spec.dofs.resize(1);
  const auto id = add_loose(world, spec);
  world.set_dofs(id, Eigen::VectorXd::Constant(1, 1.2));
  Both both(world);
  check_dofs(both, id, 1, 1e-6);
}

TEST_CASE("ODE: a floating robot, and a robot on a moving base") {
  World world;
  const auto id = add_loose(world, chain(2, {Vector3d::UnitY()}));
  world.set_dofs(id, Eigen::Vector2d(1.2, 0.5));
  SUBCASE("floating") {
    DynamicSettings settings = world.dynamic_settings();
    settings.robots[id].floating = true;
    world.set_dynamic_settings(settings);
    world.set_twist(world.robot(id).base, {{0.2, 0, 1}, {0, 1, 2}});
  }
  SUBCASE("prescribed") { world.set_twist(world.robot(id).base, {{0.2, 0, 1}, {0, 1, 2}}); }
  Both both(world);
  check_dofs(both, id, 0.5, 1e-5);
  CHECK(both.apart(world.robot(id).base) < 1e-6);
}

// two jaws that slide along x, 60 mm apart
static RobotSpec jaws() {
  RobotSpec robot;
  robot.name = "jaws";
  robot.base = body_spec("jaws_base", moved(box(0.1, 0.02, 0.02), {0, -0.03, 0}));
  for (int side = 0; side < 2; ++side) {
    DofSpec dof;
    dof.default_velocity = 0.05;
    dof.max_effort = 4;
    robot.dofs.push_back(dof);
    LinkSpec link{.body = body_spec("jaw" + std::to_string(side),
                                    moved(box(0.006, 0.03, 0.02), {0.033, 0, 0}))};
    link.body.mass = 0.1;
    if (side == 1) link.X_JL = Pose::turn(std::numbers::pi, Vector3d::UnitY());
    link.joints = {{.kind = JointKind::prismatic,
                    .axis = {side == 0 ? -1.0 : 1.0, 0, 0},
                    .dof = side,
                    .min = 0,
                    .max = 0.028}};
    robot.links.push_back(link);
  }
  return robot;
}

TEST_CASE("ODE: two jaws squeeze and hold a block that falls when they open") {
  World world;
  world.set_friction("wood", "wood", {0.6, 0.6});
  const auto hand = world.add_robot(jaws(), {});
  const auto block = add_block(world, "block", {0.03, 0.02, 0.02}, {}, 0.2);
  world.set_gravity({0, 0, 0});
  close_by_motors(world, hand, 1);
  Both both(world);
  both.run(1);
  for (World* w : {&both.ours, &both.ode}) w->set_gravity({0, 0, -9.81});
  both.run(0.5);
  // 2 x 0.6 x 4 N hold 2 N
  CHECK(std::abs(both.ode.pose(block).position.z()) < 1e-6);
  CHECK(both.apart(block) < 1e-5);
  CHECK((both.ours.dofs(hand) - both.ode.dofs(hand)).norm() < 1e-5);
  // the share of each jaw in the weight is undetermined: only rest is checked
  for (World* w : {&both.ours, &both.ode}) {
    double lifted = 0;
    for (const Manifold& m : w->dynamics()->manifolds) {
      if (m.points.empty()) continue;
      Vector3d force = Vector3d::Zero();
      for (const ManifoldPoint& p : m.points) force += w->pose(m.a).rotation * p.force;
      CHECK(std::abs(force.x()) == doctest::Approx(4).epsilon(1e-5));
      lifted += m.b == block ? force.z() : -force.z();
    }
    CHECK(lifted == doctest::Approx(0.2 * 9.81).epsilon(1e-5));
  }
  for (World* w : {&both.ours, &both.ode}) close_by_motors(*w, hand, -1);
  both.run(0.5);
  CHECK(both.ode.pose(block).position.z() < -0.1);
  CHECK(both.apart(block) < 1e-2);
}

TEST_CASE(
    "ODE: a Barrett hand, whose joints are coupled, closes on a block as with Clench's solver") {
  World world;
  const auto hand =
      add_robot(world, read_robot("models/hands/barrett/barrett.cfg", {.root = "."}), {});
  BodySpec spec = body_spec("cylinder", box(0.06, 0.06, 0.12));
  spec.mass = 0.3;
  const auto object = world.add_body(spec, BodyKind::object, Pose::translation({0, 0, 0.14}));
  world.set_gravity({0, 0, 0});
  close_by_motors(world, hand, 1);
  Both both(world);
  both.run(1.5);
  CAPTURE(both.ours.dofs(hand).transpose());
  CAPTURE(both.ode.dofs(hand).transpose());
  CHECK((both.ours.dofs(hand) - both.ode.dofs(hand)).norm() < 2e-2);
  CHECK(both.apart(object) < 2e-3);
}

TEST_CASE("ODE: repeated runs are bit-identical, also with another stepper") {
  World world;
  const auto block = add_slope(world, 0.4, 0.3);
  use(world, DynamicsEngine::ode);
  World other = world;
  Stepper stepper(world);
  for (int i = 0; i < 100; ++i) {
    stepper.solve(stepper.move(1e-3));
    Stepper again(other);
    again.solve(again.move(1e-3));
  }
  CHECK(world.pose(block) == other.pose(block));
}

TEST_CASE("ODE: masses of any size give a valid step or a one-sentence error") {
  World world;
  add_block(world, "table", {1, 1, 0.1}, {}, 1, BodyKind::obstacle);
  add_block(world, "feather", {0.06, 0.06, 0.04}, Pose::translation({0, 0, 0.0701}), 1e-12);
  add_block(world, "anvil", {0.06, 0.06, 0.04}, Pose::translation({0, 0, 0.1102}), 1e12);
  use(world, DynamicsEngine::ode);
  try {
    Stepper(world).run(0.05);
    CHECK(world.dynamics()->report.steps >= 50);
  } catch (const Error& error) {
    CHECK(std::string(error.what()).starts_with("dynamics: ODE"));
  }
}
