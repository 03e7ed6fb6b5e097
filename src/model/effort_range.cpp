#include "clench/model/effort_range.h"

#include <algorithm>
#include <cmath>

#include "clench/model/dof.h"

namespace clench {

// a side without a given limit
static EffortRange limited(const World& world, Id<Robot> robot, EffortRange range) {
  const auto& most = world.dynamic_settings().robot(robot).max_effort;
  if (!most) return range;
  if (std::isinf(range.low)) range.low = std::min(-*most, range.high);
  if (std::isinf(range.high)) range.high = std::max(*most, range.low);
  return range;
}

EffortRange effort_range(const World& world, Id<Robot> id, int dof) {
  const Robot& robot = world.robot(id);
  if (!robot.dofs[dof].driven) return {};
  return limited(world, id, robot.drives[static_cast<size_t>(dof)].at_rest(world.dofs(id)));
}

EffortRange effort_limits(const World& world, Id<Robot> id, int dof) {
  return limited(world, id, world.robot(id).drives[static_cast<size_t>(dof)].limits());
}

bool can_close(const World& world, Id<Robot> id, int dof) {
  const double pace = world.robot(id).dofs[dof].default_velocity;
  if (pace == 0) return false;
  const Robot& robot = world.robot(id);
  if (!robot.dofs[dof].driven) return false;
  Eigen::VectorXd dofs = world.dofs(id);
  const auto closes_at = [&](double q) {
    dofs[dof] = q;
    const EffortRange range = robot.drives[static_cast<size_t>(dof)].at_rest(dofs);
    return pace > 0 ? range.high > 0 : range.low < 0;
  };
  const auto [low, high] = range_around(robot, dof, world.dofs(id)[dof]);
  return closes_at(low) || closes_at(high);
}

std::vector<int> unlimited_dofs(const World& world, Id<Robot> id) {
  std::vector<int> out;
  for (int d = 0; d < static_cast<int>(world.robot(id).dofs.size()); ++d) {
    const EffortRange range = effort_range(world, id, d);
    if (std::isinf(range.low) || std::isinf(range.high)) out.push_back(d);
  }
  return out;
}

}  // namespace clench
