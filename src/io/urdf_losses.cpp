#include "clench/io/urdf_losses.h"

namespace clench {

void report_losses(const RobotSpec& robot, const RobotFolder& folder) {
  std::vector<char> moves(robot.dofs.size());
  each_joint(robot, [&](const JointSpec& joint) { moves[joint.dof] = true; });
  for (size_t d = 0; d < moves.size(); ++d)
    if (!moves[d]) folder.lost(fmt::format("DOF {}, which moves no joint", d));
  if (!robot.tactile.empty())
    folder.lost(fmt::format("the {} tactile sensors", robot.tactile.size()));
  if (!robot.tendons.empty() || !robot.wrappers.empty())
    folder.lost(
        fmt::format("the {} tendons and {} wrappers", robot.tendons.size(), robot.wrappers.size()));
}

}  // namespace clench
