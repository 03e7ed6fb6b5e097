#include "spec/compliant_coupling.h"

#include <cmath>

namespace clench {

namespace {

// axes of a chain's joints in the chain frame, all joints at 0
std::vector<Eigen::Vector3d> axes_of(const ChainSpec& chain) {
  std::vector<Eigen::Vector3d> axes;
  Eigen::Quaterniond at = Eigen::Quaterniond::Identity();
  for (const JointSpec& joint : chain.joints) {
    if (joint.placed_freely) at = at * joint.X_before.rotation;
    axes.push_back(at * Eigen::Vector3d::UnitZ());
    at = at * Eigen::AngleAxisd(joint.theta, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(joint.alpha, Eigen::Vector3d::UnitX());
    if (joint.placed_freely) at = at * joint.X_after.rotation;
  }
  return axes;
}

// what each joint of the DOF turns or slides by for one unit of the tendon's pull; empty: its ratios stand
std::vector<double> free_motion(const RobotSpec& robot, int dof) {
  std::vector<double> out;
  std::optional<JointKind> kind;
  for (const ChainSpec& chain : robot.chains) {
    const auto axes = axes_of(chain);
    for (size_t j = 0; j < chain.joints.size(); ++j) {
      const JointSpec& joint = chain.joints[j];
      if (joint.dof != dof) continue;
      if (!kind) kind = joint.kind;
      double torque = 0;
      for (size_t i = j; i < chain.joints.size(); ++i)
        if (chain.joints[i].dof == dof) torque += chain.joints[i].ratio * axes[i].dot(axes[j]);
      out.push_back(torque / joint.spring);
      const bool its_way = torque * joint.ratio > 0 && std::isfinite(out.back());
      if (joint.kind != *kind || !(joint.spring > 0) || !its_way) return {};
    }
  }
  return out;
}

}  // namespace

void couple_by_springs(RobotSpec& robot) {
  for (int dof = 0; dof < static_cast<int>(robot.dofs.size()); ++dof) {
    if (robot.dofs[dof].kind != DofKind::compliant) continue;
    const auto free = free_motion(robot, dof);
    if (free.empty()) continue;
    size_t next = 0;
    double first = 0;
    for (ChainSpec& chain : robot.chains)
      for (JointSpec& joint : chain.joints) {
        if (joint.dof != dof) continue;
        joint.pull = joint.ratio;
        if (next == 0) first = joint.pull / free[0];
        joint.ratio = first * free[next++];
      }
  }
}

}  // namespace clench
