#include "clench/planning/apply_by_arm.h"

#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "clench/motion/drive.h"

using namespace clench;

TEST_CASE("an arm moves its hand to the pose of a grasp, or nothing moves") {
  World world = build_world(read_world("worlds/puma_barrett_glass.wld", {.root = "."}));
  const auto arm = world.robots()[0], hand = world.robots()[1];
  const auto glass = world.find_body("glass");
  autograsp(world, hand);
  const Grasp grasp = find_grasp(world, hand, glass);
  const auto offset = [&] {
    return world.pose(glass).inverse() * world.pose(world.robot(hand).base);
  };
  const Eigen::VectorXd before = world.dofs(arm);

  // already at the pose: nothing moves
  const Pose X_WB = world.pose(world.robot(hand).base);
  apply_by_arm(world, grasp, hand, glass);
  CHECK(world.dofs(arm) == before);
  CHECK(world.pose(world.robot(hand).base).position == X_WB.position);

  world.set_pose(glass, Pose::translation({0.01, 0.02, 0}) * world.pose(glass));
  apply_by_arm(world, grasp, hand, glass);
  CHECK(world.dofs(arm) != before);
  // ten times the tolerance of inverse kinematics
  CHECK((offset().position - grasp.X_OH->position).norm() < 1e-8);
  CHECK((offset().inverse() * *grasp.X_OH).angle() < 1e-8);

  const Eigen::VectorXd reached = world.dofs(arm), closed = world.dofs(hand);
  world.set_pose(glass, Pose::translation({9, 0, 0}) * world.pose(glass));
  CHECK_THROWS_WITH_AS(apply_by_arm(world, grasp, hand, glass),
                       doctest::Contains("'puma560' cannot bring the hand there"), Error);
  CHECK(world.dofs(arm) == reached);
  CHECK(world.dofs(hand) == closed);
}
