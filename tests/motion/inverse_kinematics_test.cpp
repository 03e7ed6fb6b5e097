#include "clench/motion/inverse_kinematics.h"

#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "clench/model/jacobian.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double upper = 0.4, lower = 0.3;  // lengths of a planar arm [m]

// two links in the plane z = 0 and a third that turns the hand, each by its own DOF
RobotSpec planar_arm(double elbow_min, double elbow_max) {
  RobotSpec robot;
  robot.name = "arm";
  robot.base = body_spec("arm_base", box(0.05, 0.05, 0.05));
  const double ends[] = {upper, lower, 0.0};
  for (int i = 0; i < 3; ++i) {
    JointSpec joint{.X_PJ = {}, .axis = Vector3d::UnitZ(), .dof = i, .min = -3, .max = 3};
    if (i == 1) joint.min = elbow_min, joint.max = elbow_max;
    LinkSpec link{.body = body_spec("arm_link" + std::to_string(i), box(0.02, 0.02, 0.02)),
                  .parent = i - 1,
                  .joints = {joint},
                  .X_JL = Pose::translation({ends[i], 0, 0})};
    robot.links.push_back(link);
    robot.dofs.push_back({});
  }
  return robot;
}

struct Standing {
  World world;
  Id<Robot> robot;

  Id<Body> link(int i) const { return world.robot(robot).links[i].body; }
  Id<Body> last() const { return world.robot(robot).links.back().body; }
  VectorXd random(Random& random) {
    const VectorXd q = random_posture(world, robot, random);
    world.set_dofs(robot, q);
    return q;
  }
};

Standing stand(const RobotSpec& spec, const Pose& X_WB = {}) {
  Standing out;
  out.robot = out.world.add_robot(spec, X_WB);
  return out;
}

RobotSpec model(const std::string& name) {
  return read_robot(std::filesystem::path("models") / name, {});
}

const IkOptions only_place = {.orientation = IkOrientation::none};

}  // namespace

TEST_CASE(
    "a planar arm reaches targets according to the law of cosines, or the nearest point when "
    "straight") {
  Standing s = stand(planar_arm(-3, 3));
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double r = random.uniform(0.02, 1.2), phi = random.uniform(-2.5, 2.5);
    const Vector3d target(r * std::cos(phi), r * std::sin(phi), 0);
    const auto result = inverse_kinematics(s.world, s.robot, s.link(1), Pose::translation(target),
                                           {.orientation = IkOrientation::none, .starts = 40});
    CAPTURE(r);
    const double beyond = std::max({0.0, r - (upper + lower), (upper - lower) - r});
    // targets near the base require an elbow angle beyond its limit of 3 rad
    if (r < 0.12) continue;
    CHECK(result.reached == (beyond < 1e-6));
    // the minimum is flat: its position is accurate to the root of rounding
    CHECK(result.distance == doctest::Approx(beyond).epsilon(1e-9).scale(1e3));
    if (!result.reached) continue;
    const double cosine = (r * r - upper * upper - lower * lower) / (2 * upper * lower);
    CHECK(std::cos(result.dofs[1]) == doctest::Approx(cosine).epsilon(1e-4));
  }
}

TEST_CASE("a limited elbow comes as close as a fine grid of all postures") {
  Standing s = stand(planar_arm(0.3, 0.9));
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Vector3d target(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), 0.05);
    const auto result =
        inverse_kinematics(s.world, s.robot, s.link(1), Pose::translation(target), only_place);
    CHECK(result.dofs[1] >= 0.3);
    CHECK(result.dofs[1] <= 0.9);
    double least = 1e9;
    for (int a = 0; a <= 1200; ++a)
      for (int b = 0; b <= 120; ++b) {
        const double q0 = -3 + a * 0.005, q1 = 0.3 + b * 0.005;
        const Vector3d p(upper * std::cos(q0) + lower * std::cos(q0 + q1),
                         upper * std::sin(q0) + lower * std::sin(q0 + q1), 0);
        least = std::min(least, (p - target).norm());
      }
    CHECK_FALSE(result.reached);
    CHECK(result.distance <= least + 1e-9);
  }
}

TEST_CASE("shipped arms reach the pose of every posture within their limits") {
  for (const std::string name : {"arms/puma560/puma560.cfg", "arms/ur5/ur5.cfg"}) {
    CAPTURE(name);
    Standing s = stand(model(name), {Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {1, 2, 3}});
    Random random(3);
    for (int i = 0; i < 100; ++i) {
      s.random(random);
      const Pose target = s.world.pose(s.last());
      s.random(random);
      const VectorXd before = s.world.dofs(s.robot);
      const auto result = inverse_kinematics(s.world, s.robot, s.last(), target);
      CHECK(result.reached);
      CHECK(VectorXd(s.world.dofs(s.robot)) == before);
      s.world.set_dofs(s.robot, result.dofs);  // which rejects values outside
      const Pose left = s.world.pose(s.last()).inverse() * target;
      CHECK(left.position.norm() == doctest::Approx(result.distance).epsilon(1e-6).scale(1e-6));
      CHECK(left.position.norm() <= 1e-6);
      CHECK(left.angle() <= 1.001e-6);
    }
  }
}

TEST_CASE("if only an axis is matched, any rotation about it is accepted") {
  Standing s = stand(model("arms/ur5/ur5.cfg"));
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    s.random(random);
    const Pose X_BT = Pose::translation({0, 0.02, 0.1});
    const Pose target = s.world.pose(s.last()) * X_BT * Pose::turn(2, Vector3d::UnitZ());
    s.random(random);
    const auto result =
        inverse_kinematics(s.world, s.robot, s.last(), target,
                           {.X_BT = X_BT, .orientation = IkOrientation::axis, .starts = 40});
    REQUIRE(result.reached);
    s.world.set_dofs(s.robot, result.dofs);
    const Pose X_WT = s.world.pose(s.last()) * X_BT;
    CHECK((X_WT.position - target.position).norm() <= 1.001e-6);
    CHECK((X_WT.rotation * Vector3d::UnitZ() - target.rotation * Vector3d::UnitZ()).norm() < 2e-6);
  }
}

TEST_CASE("fixed DOFs stay, and results do not depend on the pose of the world") {
  Standing here = stand(model("arms/ur5/ur5.cfg"));
  const Pose X{Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5), {3, -2, 1}};
  Standing there = stand(model("arms/ur5/ur5.cfg"), X);
  const Pose target = Pose::translation({0.4, 0.2, 0.5});
  const IkOptions options = {.orientation = IkOrientation::none, .dofs = {1, 2}};
  const auto a = inverse_kinematics(here.world, here.robot, here.last(), target, options);
  const auto b = inverse_kinematics(there.world, there.robot, there.last(), X * target, options);
  for (const int dof : {0, 3, 4, 5}) CHECK(a.dofs[dof] == here.world.dofs(here.robot)[dof]);
  // two of six DOFs leave a distance with a flat minimum: positions agree to the root of rounding
  CHECK(a.distance > 1e-3);
  CHECK(a.distance == doctest::Approx(b.distance).epsilon(1e-9));
}

TEST_CASE("colliding solutions are skipped") {
  Standing s = stand(planar_arm(-3, 3));
  const Pose target = Pose::translation({0.5, 0, 0});
  const auto free = inverse_kinematics(s.world, s.robot, s.link(1), target, only_place);
  REQUIRE(free.reached);
  // a post at the position of the elbow
  s.world.set_dofs(s.robot, free.dofs);
  const auto post = s.world.add_body(body_spec("post", box(0.03, 0.03, 0.03)), BodyKind::obstacle,
                                     s.world.pose(s.link(0)));
  IkOptions options = only_place;
  options.collision_free = true;
  const auto other = inverse_kinematics(s.world, s.robot, s.link(1), target, options);
  CHECK(other.reached);
  CHECK(other.in_collision >= 1);
  // the elbow on the other side
  CHECK(other.dofs[1] == doctest::Approx(-free.dofs[1]).epsilon(1e-4));
  s.world.add_body(body_spec("wall", box(0.1, 2, 0.1)), BodyKind::obstacle,
                   Pose::translation({0.5, 0, 0}));
  const auto none = inverse_kinematics(s.world, s.robot, s.link(1), target, options);
  CHECK_FALSE(none.reached);
  CHECK(none.starts == options.starts);
  CHECK(none.distance <= 1e-6);
  CHECK(none.in_collision > 0);
  CHECK(s.world.alive(post));
}

TEST_CASE("an arm moves the hand that it carries to its target") {
  Standing s = stand(model("arms/puma560/puma560.cfg"));
  const auto hand = s.world.add_robot(model("hands/barrett/barrett.cfg"), {});
  s.world.mount(hand, s.robot, static_cast<int>(s.world.robot(s.robot).links.size()) - 1,
                Pose::translation({0, 0, 0.05}));
  Random random(5);
  s.random(random);
  const auto palm = s.world.robot(hand).base, tip = s.world.robot(hand).links.back().body;
  const Pose at_palm = s.world.pose(palm), at_tip = s.world.pose(tip);
  s.random(random);
  const auto result = inverse_kinematics(s.world, s.robot, palm, at_palm);
  REQUIRE(result.reached);
  s.world.set_dofs(s.robot, result.dofs);
  CHECK((s.world.pose(tip).position - at_tip.position).norm() < 1e-5);
}

TEST_CASE("Jacobians equal the effect of small steps of the DOFs") {
  for (const std::string name : {"arms/puma560/puma560.cfg", "hands/barrett/barrett.cfg",
                                 "hands/parallel_jaw/parallel_jaw.cfg"}) {
    CAPTURE(name);
    Standing s = stand(model(name));
    Random random(6);
    const VectorXd q = s.random(random);
    for (const Link& link : s.world.robot(s.robot).links) {
      const Vector3d p_B(0.01, -0.02, 0.03);
      const Pose before = s.world.pose(link.body);
      const Eigen::MatrixXd J = dof_jacobian(s.world, s.robot, link.body, before * p_B);
      for (int d = 0; d < q.size(); ++d) {
        // central differences: errors of the square of the step, and of rounding divided by it
        constexpr double step = 1e-6;
        VectorXd at = q;
        at[d] = q[d] + step;
        s.world.set_dofs_unchecked(s.robot, at, {});
        const Pose up = s.world.pose(link.body);
        at[d] = q[d] - step;
        s.world.set_dofs_unchecked(s.robot, at, {});
        const Pose down = s.world.pose(link.body);
        const Vector3d v = (up * p_B - down * p_B) / (2 * step);
        const Eigen::AngleAxisd turn(up.rotation * down.rotation.conjugate());
        CHECK((J.col(d).head<3>() - v).norm() < 1e-8);
        CHECK((J.col(d).tail<3>() - turn.angle() * turn.axis() / (2 * step)).norm() < 1e-8);
      }
      s.world.set_dofs(s.robot, q);
    }
  }
}

TEST_CASE("a body that no DOF moves and options out of range are rejected") {
  Standing s = stand(planar_arm(-1, 1));
  const auto solve = [&](Id<Body> body, const Pose& pose, const IkOptions& options) {
    inverse_kinematics(s.world, s.robot, body, pose, options);
  };
  CHECK_THROWS_WITH_AS(solve(s.world.robot(s.robot).base, {}, {}),
                       "inverse kinematics of 'arm': none of the selected DOFs moves 'arm_base'",
                       Error);
  CHECK_THROWS_WITH_AS(solve(s.link(0), {}, {.dofs = {1}}),
                       "inverse kinematics of 'arm': none of the selected DOFs moves 'arm_link0'",
                       Error);
  CHECK_THROWS_WITH_AS(solve(s.link(0), {}, {.dofs = {3}}),
                       "inverse kinematics of 'arm': expected DOFs from 1 to 3, got 4", Error);
  CHECK_THROWS_WITH_AS(solve(s.link(0), {}, {.starts = 0}),
                       "inverse kinematics of 'arm': starts: expected 1 to 1000000, got 0", Error);
  CHECK_THROWS_WITH_AS(solve(s.link(0), {}, {.tolerance = 0}),
                       "inverse kinematics of 'arm': expected a tolerance > 0, got 0", Error);
  CHECK_THROWS_WITH_AS(solve(s.link(0), Pose::translation({NAN, 0, 0}), {}),
                       "inverse kinematics of 'arm': expected a finite pose", Error);
}
