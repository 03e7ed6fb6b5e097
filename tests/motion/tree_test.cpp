// Robots whose chains branch, and joints that a file places freely.
#include <array>
#include <random>

#include "base/error.h"
#include "motion/blocked_joints.h"
#include "motion/drive.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

Pose random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Eigen::Quaterniond q(unit(random), unit(random), unit(random), unit(random));
  return {q.normalized(), {0.1 * unit(random), 0.1 * unit(random), 0.1 * unit(random)}};
}

// chains of random joints, each beginning on the base or on a random link before it
RobotSpec random_tree(std::mt19937& random, int chains) {
  std::uniform_real_distribution<double> unit(-1, 1);
  RobotSpec robot;
  robot.name = "tree";
  robot.base = body_spec("tree_base", box(0.01, 0.01, 0.01));
  for (int c = 0; c < chains; ++c) {
    ChainSpec chain;
    chain.parent_chain = c == 0 ? -1 : static_cast<int>(random() % (c + 1)) - 1;
    if (chain.parent_chain >= 0)
      chain.parent_link =
          static_cast<int>(random() % robot.chains[chain.parent_chain].links.size());
    chain.X_BC = random_pose(random);
    for (int j = 0; j < 2; ++j) {
      JointSpec joint;
      joint.kind = random() % 3 ? JointKind::revolute : JointKind::prismatic;
      joint.dof = static_cast<int>(robot.dofs.size());
      joint.theta = unit(random), joint.d = 0.1 * unit(random);
      joint.a = 0.1 * unit(random), joint.alpha = unit(random);
      joint.min = -1, joint.max = 1;
      joint.placed_freely = random() % 2;
      joint.X_before = random_pose(random), joint.X_after = random_pose(random);
      robot.dofs.emplace_back();
      chain.joints.push_back(joint);
      LinkSpec link;
      link.body = body_spec("tree_link", box(0.01, 0.01, 0.01));
      link.last_joint = j;
      chain.links.push_back(link);
    }
    robot.chains.push_back(chain);
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
Eigen::Matrix4d slow_link(const RobotSpec& robot, const Eigen::VectorXd& q, int c, int link) {
  const ChainSpec& chain = robot.chains[c];
  Eigen::Matrix4d m = matrix(chain.X_BC);
  for (int j = 0; j <= chain.links[link].last_joint; ++j) {
    const JointSpec& joint = chain.joints[j];
    const bool turns = joint.kind == JointKind::revolute;
    const Pose identity;
    m = m * matrix(joint.placed_freely ? joint.X_before : identity) *
        matrix(Pose::turn(joint.theta + (turns ? q[joint.dof] : 0), Eigen::Vector3d::UnitZ())) *
        matrix(Pose::translation({0, 0, joint.d + (turns ? 0 : q[joint.dof])})) *
        matrix(Pose::translation({joint.a, 0, 0})) *
        matrix(Pose::turn(joint.alpha, Eigen::Vector3d::UnitX())) *
        matrix(joint.placed_freely ? joint.X_after : identity);
  }
  if (chain.parent_chain < 0) return m;
  return slow_link(robot, q, chain.parent_chain, chain.parent_link) * m;
}

// the same finger as one chain, or as a chain for each link
RobotSpec cut_fingers(RobotSpec robot) {
  std::vector<ChainSpec> cut;
  for (const ChainSpec& whole : robot.chains) {
    ChainSpec first = whole, second;
    first.joints.resize(1), first.links.resize(1);
    second.parent_chain = static_cast<int>(cut.size()), second.parent_link = 0;
    second.joints = {whole.joints[1]};
    second.links = {whole.links[1]};
    second.links[0].last_joint = 0;
    cut.push_back(first);
    cut.push_back(second);
  }
  robot.chains = cut;
  return robot;
}

}  // namespace

TEST_CASE("links of a tree stand where the product of all motions before them puts them") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 20; ++round) {
    const RobotSpec spec = random_tree(random, 5);
    World world;
    const auto id = world.add_robot(spec, {});
    Eigen::VectorXd q(spec.dofs.size());
    for (double& x : q) x = unit(random);
    world.set_dofs(id, q);
    const Robot& robot = world.robot(id);
    for (int c = 0; c < 5; ++c)
      for (int l = 0; l < 2; ++l) {
        const Pose& X_WL = world.body(robot.chains[c].links[l]).X_WB;
        // thirty products of numbers near 1
        CHECK((matrix(X_WL) - slow_link(spec, q, c, l)).cwiseAbs().maxCoeff() < 1e-13);
      }
  }
}

TEST_CASE("a joint moves the links that turning it moves") {
  std::mt19937 random(2);
  const RobotSpec spec = random_tree(random, 6);
  World world;
  const auto id = world.add_robot(spec, {});
  for (int c = 0; c < 6; ++c)
    for (int j = 0; j < 2; ++j) {
      const World before = world;
      Eigen::VectorXd q = world.robot(id).q;
      q[spec.chains[c].joints[j].dof] += 0.1;
      World after = world;
      after.set_dofs(id, q);
      for (const auto body : world.bodies_of(id)) {
        const bool moved = !(before.body(body).X_WB == after.body(body).X_WB);
        CHECK(joint_moves(world, id, {c, j}, body) == moved);
      }
    }
}

TEST_CASE("a hand of cut chains closes as the hand of whole ones does") {
  for (const auto kind : {DofKind::rigid, DofKind::breakaway}) {
    const auto close = [&](const RobotSpec& spec) {
      World world;
      const auto hand = world.add_robot(spec, {});
      world.add_body(body_spec("ball", ball(0.015)), BodyKind::object,
                     Pose::translation({0, 0.07, 0}));
      autograsp(world, hand);
      CHECK(colliding_pairs(world).empty());
      return world.robot(hand).q;
    };
    const Eigen::VectorXd whole = close(two_finger(kind)),
                          cut = close(cut_fingers(two_finger(kind)));
    // the same geometry by other products: rounding may end an advance at another place in the threshold
    CHECK((whole - cut).cwiseAbs().maxCoeff() < 1e-3);
  }
}

TEST_CASE("neighbours in a tree never collide, over frames without a shape too") {
  RobotSpec spec = cut_fingers(two_finger());
  spec.chains[0].links[0].body.shape = nullptr;
  spec.chain_links_collide = true;
  World world;
  const auto id = world.add_robot(spec, {});
  const Robot& robot = world.robot(id);
  CHECK_FALSE(world.may_collide(robot.base, robot.chains[1].links[0]));
  CHECK_FALSE(world.may_collide(robot.chains[2].links[0], robot.chains[3].links[0]));
  CHECK(world.may_collide(robot.base, robot.chains[3].links[0]));
}

TEST_CASE("a chain begins on a link that exists, of a chain before it") {
  RobotSpec spec = cut_fingers(two_finger());
  World world;
  spec.chains[1].parent_chain = 1;
  CHECK_THROWS_WITH_AS(
      world.add_robot(spec, {}),
      "gripper: chain 1: expected to begin on the base or on a chain before it, got chain 1",
      Error);
  spec.chains[1].parent_chain = 0, spec.chains[1].parent_link = 1;
  CHECK_THROWS_WITH_AS(world.add_robot(spec, {}),
                       "gripper: chain 1: expected to begin on one of 1 links of chain 0, got 1",
                       Error);
  spec = two_finger();
  spec.chains[0].joints[1].X_after.position.x() = NAN;
  CHECK_THROWS_WITH_AS(
      world.add_robot(spec, {}),
      "gripper: chain 0 joint 1: expected a position within 1e+09 m of the origin, got (nan, 0, 0)",
      Error);
}
