#include "clench/model/jacobian.h"

#include "clench/model/carrying.h"

namespace clench {

Eigen::MatrixXd joint_jacobian(const Robot& robot, const RobotFrames& frames, int link,
                               const Eigen::Vector3d& p) {
  const int count = static_cast<int>(robot.joints.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6, count);
  for (int j = 0; j < count; ++j) {
    if (!joint_moves_link(robot, j, link)) continue;
    out.col(j).head<3>() = frames.velocity(robot, j, p);
    if (robot.joints[j].kind == JointKind::revolute) out.col(j).tail<3>() = frames.axis(robot, j);
  }
  return out;
}

Eigen::MatrixXd dof_jacobian(const World& world, Id<Robot> id, Id<Body> body,
                             const Eigen::Vector3d& p_W) {
  const Robot& robot = world.robot(id);
  const Eigen::MatrixXd joints =
      joint_jacobian(robot, world.frames(id), carrying_link(world, id, body), p_W);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6, static_cast<int>(robot.dofs.size()));
  for (int j = 0; j < joints.cols(); ++j)
    if (world.follows_dof(id, j))
      out.col(robot.joints[j].dof) += robot.joints[j].ratio * joints.col(j);
  return out;
}

}  // namespace clench
