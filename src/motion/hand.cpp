#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/motion/blocked_joints.h"
#include "clench/motion/drive.h"

namespace clench {

DriveResult autograsp(World& world, Id<Robot> id, double speed, const DriveOptions& options) {
  const Robot& robot = world.robot(id);
  if (!std::isfinite(speed) || speed == 0)
    fail("autograsp of '{}': the speed must be finite and not 0, got {}", excerpt(robot.name),
         speed);
  DofMotion motion{world.dofs(id), Eigen::VectorXd::Zero(world.dofs(id).size())};
  for (int i = 0; i < motion.rates.size(); ++i) {
    motion.rates[i] = robot.dofs[i].default_velocity * speed;
    if (motion.rates[i] != 0) motion.targets[i] = robot.limits[i][motion.rates[i] > 0];
  }
  return drive(world, id, motion, options);
}

// opens in steps without regard to contacts until nothing collides
static void open_until_free(World& world, Id<Robot> id) {
  constexpr int steps = 200;
  const Robot& robot = world.robot(id);
  const auto moving = movable_bodies(world, id);
  const Eigen::VectorXd start = world.dofs(id);
  Eigen::VectorXd open = start;
  for (int i = 0; i < open.size(); ++i) {
    const double v = robot.dofs[i].default_velocity;
    if (v != 0) open[i] = robot.limits[i][v < 0];
  }
  const auto before = world.snapshot();
  for (int step = 0; !colliding_pairs(world, moving, world.bodies(), &world.context()).empty();
       ++step) {
    if (step == steps) {
      const auto pairs = colliding_pairs(world, moving, world.bodies(), &world.context());
      const std::string sentence = fmt::format("opening '{}': it is never free of collision: {}",
                                               excerpt(robot.name), describe(world, pairs));
      world.restore(*before);
      throw Error(sentence);
    }
    world.set_dofs(id, start + (open - start) * (step + 1.0) / steps);
  }
}

DriveResult open_hand(World& world, Id<Robot> id) {
  open_until_free(world, id);
  return autograsp(world, id, -1);
}

}  // namespace clench
