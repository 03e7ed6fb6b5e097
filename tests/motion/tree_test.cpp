// Robots as trees: links of several joints, with arbitrary frames.
#include <array>
#include <random>

#include "clench/base/error.h"
#include "clench/motion/blocked_joints.h"
#include "clench/motion/drive.h"
#include "support/chains.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

Pose random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Eigen::Quaterniond q(unit(random), unit(random), unit(random), unit(random));
  return {q.normalized(), {0.1 * unit(random), 0.1 * unit(random), 0.1 * unit(random)}};
}

// links of zero, one or two random joints, each on the base or on a random link before it
RobotSpec random_tree(std::mt19937& random, int links) {
  std::uniform_real_distribution<double> unit(-1, 1);
  RobotSpec robot;
  robot.name = "tree";
  robot.base = body_spec("tree_base", box(0.01, 0.01, 0.01));
  for (int l = 0; l < links; ++l) {
    LinkSpec link{.body = body_spec("tree_link", box(0.01, 0.01, 0.01))};
    link.parent = static_cast<int>(random() % (l + 1)) - 1;
    link.X_JL = random_pose(random);
    for (size_t joints = random() % 3; joints > 0; --joints) {
      JointSpec joint;
      joint.kind = random() % 3 ? JointKind::revolute : JointKind::prismatic;
      joint.dof = static_cast<int>(robot.dofs.size());
      joint.X_PJ = random_pose(random);
      joint.axis = Eigen::Vector3d(unit(random), unit(random), unit(random)).normalized();
      joint.min = -1, joint.max = 1;
      robot.dofs.emplace_back();
      link.joints.push_back(joint);
    }
    robot.links.push_back(link);
  }
  return robot;
}

Eigen::Matrix4d matrix(const Pose& pose) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = pose.matrix();
  m.topRightCorner<3, 1>() = pose.position;
  return m;
}

// elementary motions multiplied as matrices, from the link up to the base
Eigen::Matrix4d slow_link(const RobotSpec& robot, const Eigen::VectorXd& q, int number) {
  const LinkSpec& link = robot.links[number];
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  for (const JointSpec& joint : link.joints) {
    const double x = joint.ratio * q[joint.dof];
    m = m * matrix(joint.X_PJ) *
        matrix(joint.kind == JointKind::revolute ? Pose::turn(x, joint.axis)
                                                 : Pose::translation(x * joint.axis));
  }
  m = m * matrix(link.X_JL);
  return link.parent < 0 ? m : slow_link(robot, q, link.parent) * m;
}

}  // namespace

TEST_CASE("links of a tree have the poses of the product of all motions before them") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 20; ++round) {
    const RobotSpec spec = random_tree(random, 10);
    World world;
    const auto id = world.add_robot(spec, {});
    Eigen::VectorXd q(spec.dofs.size());
    for (double& x : q) x = unit(random);
    world.set_dofs(id, q);
    const auto poses = link_poses(spec, {q.begin(), q.end()});
    for (int l = 0; l < 10; ++l) {
      const Pose& X_WL = world.pose(world.robot(id).links[l].body);
      // thirty products of numbers near 1
      CHECK((matrix(X_WL) - slow_link(spec, q, l)).cwiseAbs().maxCoeff() < 1e-13);
      CHECK((matrix(poses[l]) - slow_link(spec, q, l)).cwiseAbs().maxCoeff() < 1e-13);
    }
  }
}

TEST_CASE("a joint moves exactly the links behind it") {
  std::mt19937 random(2);
  const RobotSpec spec = random_tree(random, 12);
  World world;
  const auto id = world.add_robot(spec, {});
  const CarriedBodies bodies(world, id);
  for (int j = 0; j < static_cast<int>(joints_of(spec).size()); ++j) {
    World after = world;
    Eigen::VectorXd q = world.dofs(id);
    q[world.robot(id).joints[j].dof] += 0.1;
    after.set_dofs(id, q);
    for (const auto body : world.bodies_of(id)) {
      const bool moved = !(world.pose(body) == after.pose(body));
      CHECK(joint_moves(world, id, j, body) == moved);
      CHECK(bodies.moved_by(j, body) == moved);
    }
  }
}

TEST_CASE("closing a hand does not depend on its links' frames") {
  std::mt19937 random(3);
  for (const auto kind : {DofKind::rigid, DofKind::breakaway}) {
    const auto close = [&](const RobotSpec& spec) {
      World world;
      const auto hand = world.add_robot(spec, {});
      world.add_body(body_spec("ball", ball(0.015)), BodyKind::object,
                     Pose::translation({0, 0.07, 0}));
      autograsp(world, hand);
      CHECK(colliding_pairs(world).empty());
      return Eigen::VectorXd(world.dofs(hand));
    };
    RobotSpec moved = two_finger(kind);
    for (LinkSpec& link : moved.links) {
      const Pose X_LN = random_pose(random);  // the new frame in the old one
      link.X_JL = link.X_JL * X_LN;
      Mesh mesh = link.body.shape->mesh();
      for (auto& v : mesh.vertices) v = X_LN.inverse() * v;
      link.body.shape = Shape::make(mesh);
      for (LinkSpec& child : moved.links)
        if (child.parent == &link - moved.links.data())
          child.joints[0].X_PJ = X_LN.inverse() * child.joints[0].X_PJ;
    }
    // the same geometry by other products: rounding may change the final position within the
    // threshold
    CHECK((close(two_finger(kind)) - close(moved)).cwiseAbs().maxCoeff() < 1e-3);
  }
}

TEST_CASE("neighbors in a tree never collide, also across frames without a shape") {
  RobotSpec spec = two_finger();
  spec.links[0].body.shape = nullptr;
  spec.chain_links_collide = true;
  World world;
  const Robot& robot = world.robot(world.add_robot(spec, {}));
  CHECK_FALSE(world.may_collide(robot.base, robot.links[1].body));
  CHECK_FALSE(world.may_collide(robot.links[2].body, robot.links[3].body));
  CHECK(world.may_collide(robot.base, robot.links[3].body));
}
