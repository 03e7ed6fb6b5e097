// Mass matrices, forces and motions of trees, compared with sums over bodies and closed formulas.
#include <cmath>

#include "clench/base/random.h"
#include "clench/dynamics/mechanics.h"
#include "clench/dynamics/weld.h"
#include "clench/model/jacobian.h"
#include "support/cases.h"
#include "support/pendulums.h"

using namespace clench;
using namespace clench::test;

namespace {

double total(const World& world) {
  const MechanicalEnergy e = mechanical_energy(world);
  return e.kinetic + e.potential;
}

RobotSpec crooked() {
  RobotSpec robot = pendulum(4, {{0, 1, 0}, {1, 0.2, 0}, {0, 0, 1}, {0.3, 1, 0.5}});
  robot.links[2].joints[0].kind = JointKind::prismatic;
  // two joints of one DOF
  robot.links[3].joints[0].dof = 1;
  robot.links[3].joints[0].ratio = -0.6;
  robot.dofs.resize(3);
  return robot;
}

}  // namespace

TEST_CASE("the mass matrix equals the sum over bodies of mass terms by their Jacobians") {
  World world;
  const auto id = add_free_robot(world, crooked());
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    Eigen::VectorXd q(3);
    for (double& x : q) x = random.uniform(-2, 2);
    world.set_dofs(id, q);
    const System system = find_system(world);
    REQUIRE(system.trees.size() == 1);
    TreeDynamics dynamics;
    dynamics.place(world, system.trees[0]);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3, 3);
    for (const Link& link : world.robot(id).links) {
      const Body& body = world.body(link.body);
      const Eigen::MatrixXd J =
          dof_jacobian(world, id, link.body, world.pose(link.body) * body.com);
      const Eigen::Matrix3d R = world.pose(link.body).matrix();
      sum += body.mass * J.topRows(3).transpose() * J.topRows(3) +
             J.bottomRows(3).transpose() * R * (body.mass * body.inertia_per_mass) * R.transpose() *
                 J.bottomRows(3);
    }
    // entries of about ten, sums of some hundred terms
    CHECK((dynamics.mass_matrix() - sum).cwiseAbs().maxCoeff() < 1e-11);
  }
}

TEST_CASE("the bias satisfies Lagrange's equation by finite differences of the energies") {
  World world;
  const auto id = add_free_robot(world, crooked());
  Random random(5);
  const auto mass_matrix = [&](const Eigen::VectorXd& q) {
    world.set_dofs(id, q);
    TreeDynamics dynamics;
    const System system = find_system(world);
    dynamics.place(world, system.trees[0]);
    return Eigen::MatrixXd(dynamics.mass_matrix());
  };
  const auto potential = [&](const Eigen::VectorXd& q) {
    world.set_dofs(id, q);
    return mechanical_energy(world).potential;
  };
  for (int round = 0; round < 10; ++round) {
    Eigen::VectorXd q(3), v(3);
    for (double& x : q) x = random.uniform(-1, 1);
    for (double& x : v) x = random.uniform(-2, 2);
    // d/dt (M v) - 1/2 d(v M v)/dq + dV/dq without accelerations
    constexpr double e = 1e-5;
    Eigen::VectorXd expected = (mass_matrix(q + e * v) - mass_matrix(q - e * v)) / (2 * e) * v;
    for (int i = 0; i < 3; ++i) {
      const Eigen::VectorXd d = e * Eigen::VectorXd::Unit(3, i);
      expected[i] += ((potential(q + d) - potential(q - d)) -
                      0.5 * (v.dot(mass_matrix(q + d) * v) - v.dot(mass_matrix(q - d) * v))) /
                     (2 * e);
    }
    world.set_dofs(id, q);
    const System system = find_system(world);
    TreeDynamics dynamics;
    dynamics.place(world, system.trees[0]);
    const Eigen::VectorXd bias = dynamics.find_bias(v, Vector6d::Zero(), world.gravity());
    // second differences of numbers of about ten at 1e-5
    CHECK((bias - expected).cwiseAbs().maxCoeff() < 1e-6);

    // and the inverse: forces that cause these accelerations
    Eigen::VectorXd change(3);
    for (double& x : change) x = random.uniform(-3, 3);
    const auto& efforts =
        dynamics.inverse_dynamics(v, change, Vector6d::Zero(), world.gravity(), {});
    Eigen::VectorXd together = Eigen::VectorXd::Zero(3);
    for (size_t j = 0; j < system.trees[0].joints.size(); ++j)
      together[system.trees[0].joints[j].coordinate] +=
          system.trees[0].joints[j].ratio * efforts[j];
    CHECK((together - bias - dynamics.mass_matrix() * change).cwiseAbs().maxCoeff() < 1e-10);
  }
}

TEST_CASE(
    "a pendulum swings with the period of the elliptic integral, with first-order convergence in "
    "the step") {
  // a rod about its end: w^2 = 3 g / 2 l; from 60 degrees the period is longer by the
  // arithmetic-geometric mean
  const double amplitude = std::numbers::pi / 3;
  double a = 1, b = std::cos(amplitude / 2);
  for (int i = 0; i < 6; ++i) std::tie(a, b) = std::pair((a + b) / 2, std::sqrt(a * b));
  double error_before = 0;
  for (const double step : {2e-3, 1e-3, 5e-4}) {
    World world;
    const auto id = add_free_robot(world, pendulum(1));
    // the rod is 3 cm wide: inertia about its middle from its mesh
    const Body& rod = world.body(world.robot(id).links[0].body);
    const double inertia = rod.inertia_per_mass(1, 1) + 0.25;
    const double period = 2 * std::numbers::pi * std::sqrt(inertia / (g * 0.5)) / a;
    world.set_dofs(id, Eigen::VectorXd::Constant(1, amplitude));
    set_step(world, step);
    run(world, period / 4);
    const double error = std::abs(world.dofs(id)[0]);
    CHECK(error < 3 * step);
    // first order: half the step, half the error
    if (error_before > 0) CHECK(error / error_before == doctest::Approx(0.5).epsilon(0.05));
    error_before = error;
  }
}

TEST_CASE("a double pendulum keeps its energy, with first-order convergence in the step") {
  double before = 0;
  for (const double step : {1e-3, 5e-4, 2.5e-4}) {
    World world;
    const auto id = add_free_robot(world, pendulum(2, {{0, 1, 0}, {0, 1, 0}}));
    world.set_dofs(id, Eigen::Vector2d(1.5, 0.5));
    const double energy = total(world);
    set_step(world, step);
    double worst = 0;
    Stepper stepper(world);
    for (int i = 0; i < 20; ++i) {
      stepper.run(0.1);
      worst = std::max(worst, std::abs(total(world) - energy));
    }
    // of some 20 J
    CHECK(worst < 40 * step);
    if (before > 0) CHECK(worst / before < 0.65);
    before = worst;
  }
}

TEST_CASE("a floating robot keeps its momentum for any motion of its joints") {
  World world;
  world.set_gravity({0, 0, 0});
  const auto id = add_free_robot(world, crooked(), true);
  world.set_dof_velocities(id, Eigen::Vector3d(3, -2, 0.5));
  world.set_twist(world.robot(id).base, {{0.1, 0.2, -0.1}, {1, 0.5, -2}});
  Stepper stepper(world);
  stepper.solve(1e-9);  // computes the twists of its links
  const Momentum first = momentum(world);
  stepper.run(0.5);
  const Momentum last = momentum(world);
  CHECK((last.linear - first.linear).norm() < 1e-12 * first.linear.norm());
  CHECK((last.angular - first.angular).norm() < 1e-12 * first.angular.norm());
}

TEST_CASE("a floating robot keeps its momentum with bodies welded to its links") {
  Random random(9);
  for (int round = 0; round < cases(10); ++round) {
    World world;
    world.set_gravity({0, 0, 0});
    const auto id = add_free_robot(world, crooked(), true);
    const auto far = [&] {
      return Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    BodySpec brick = body_spec("brick", box(0.1, 0.2, 0.3));
    brick.mass = random.uniform(0.1, 20);
    const auto object = world.add_body(brick, BodyKind::object, Pose::translation(far()));
    const auto& links = world.robot(id).links;
    weld(world, object, links[round % links.size()].body);
    world.set_dof_velocities(id, 3 * far());
    world.set_twist(world.robot(id).base, {far(), 3 * far()});
    Stepper stepper(world);
    stepper.solve(1e-9);
    const Momentum first = momentum(world);
    stepper.run(0.3);
    const Momentum last = momentum(world);
    CHECK((last.linear - first.linear).norm() < 1e-11 * first.linear.norm());
    CHECK((last.angular - first.angular).norm() < 1e-11 * first.angular.norm());
  }
}

TEST_CASE(
    "a free rotating body keeps its angular momentum up to rounding, and its energy to fourth "
    "order") {
  World world;
  world.set_gravity({0, 0, 0});
  BodySpec spec = body_spec("brick", box(0.02, 0.06, 0.1));
  const auto id = world.add_body(spec, BodyKind::object, {});
  world.set_twist(id, {{0, 0, 0}, {0.1, 8, 0.1}});
  const Momentum first = momentum(world);
  const double energy = total(world);
  run(world, 2);
  CHECK((momentum(world).angular - first.angular).norm() < 1e-12 * first.angular.norm());
  CHECK(std::abs(total(world) - energy) < 1e-9 * energy);
}

TEST_CASE("slender and flat bodies that spin fast keep energy and angular momentum") {
  for (const Eigen::Vector3d& size :
       {Eigen::Vector3d(0.4, 0.004, 0.004), Eigen::Vector3d(0.15, 0.008, 0.008),
        Eigen::Vector3d(0.2, 0.2, 0.002)})
    for (const Eigen::Vector3d& w :
         {Eigen::Vector3d(3, 0, 100), Eigen::Vector3d(0, 0, 500), Eigen::Vector3d(60, 1, 2)}) {
      World world;
      world.set_gravity({0, 0, 0});
      const auto id =
          world.add_body(body_spec("rod", box(size.x(), size.y(), size.z())), BodyKind::object,
                         Pose::turn(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
      world.set_twist(id, {{0, 0, 0}, w});
      const Momentum first = momentum(world);
      const double energy = total(world);
      run(world, 2);
      CHECK((momentum(world).angular - first.angular).norm() < 1e-11 * first.angular.norm());
      // a tenth of a radian per step of fourth order
      CHECK(std::abs(total(world) - energy) < 1e-4 * energy);
    }
}
