#include <algorithm>
#include <cmath>
#include <numeric>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/dof.h"
#include "clench/motion/blocked_joints.h"
#include "clench/motion/drive.h"

namespace clench {

static DriveResult close_stage(World& world, Id<Robot> id, double speed, const DofGroup& dofs,
                               const DriveOptions& options) {
  const Robot& robot = world.robot(id);
  DofMotion motion{world.dofs(id), Eigen::VectorXd::Zero(world.dofs(id).size())};
  for (const int i : dofs) {
    motion.rates[i] = robot.dofs[i].default_velocity * speed;
    if (motion.rates[i] != 0)
      motion.targets[i] = range_around(robot, i, motion.targets[i])[motion.rates[i] > 0];
  }
  return drive(world, id, motion, options);
}

// adds the result of a stage to that of the previous ones
static void add(DriveResult& all, const DriveResult& stage) {
  all.moved = all.moved || stage.moved;
  for (size_t i = 0; i < stage.stops.size(); ++i)
    if (stage.stops[i] != DofStop::not_driven) all.stops[i] = stage.stops[i];
  for (const BodyPair& pair : stage.stopped_by)
    if (std::ranges::find(all.stopped_by, pair) == all.stopped_by.end())
      all.stopped_by.push_back(pair);
  all.queries += stage.queries;
  all.events += stage.events;
}

DriveResult autograsp(World& world, Id<Robot> id, double speed, const DriveOptions& options,
                      const std::vector<DofGroup>& stages) {
  const Robot& robot = world.robot(id);
  if (!std::isfinite(speed) || speed == 0)
    fail("autograsp of '{}': the speed must be finite and not 0, got {}", excerpt(robot.name),
         speed);
  DofGroup all(robot.dofs.size());
  std::iota(all.begin(), all.end(), 0);
  for (const DofGroup& stage : stages) check_dof_numbers(robot, stage, "autograsp");
  if (stages.empty()) return close_stage(world, id, speed, all, options);
  DriveResult result;
  result.stops.assign(all.size(), DofStop::not_driven);
  for (const DofGroup& stage : stages) add(result, close_stage(world, id, speed, stage, options));
  return result;
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
    if (v != 0) open[i] = range_around(robot, i, open[i])[v < 0];
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
