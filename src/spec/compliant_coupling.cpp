#include "clench/spec/compliant_coupling.h"

#include <cmath>

namespace clench {

namespace {

struct JointAxis {
  const JointSpec* joint;
  int link;
  Eigen::Vector3d axis;  // in the base, all joints at 0
};

std::vector<JointAxis> axes_of(const RobotSpec& robot) {
  std::vector<JointAxis> out;
  std::vector<Eigen::Quaterniond> links;
  for (int l = 0; l < static_cast<int>(robot.links.size()); ++l) {
    const LinkSpec& link = robot.links[l];
    Eigen::Quaterniond at = link.parent < 0 ? Eigen::Quaterniond::Identity() : links[link.parent];
    for (const JointSpec& joint : link.joints) {
      at = at * joint.X_PJ.rotation;
      out.push_back({&joint, l, at * joint.axis});
    }
    links.push_back(at * link.X_JL.rotation);
  }
  return out;
}

// is the link the other one, or in its subtree?
bool beyond(const RobotSpec& robot, int link, int other) {
  while (link > other) link = robot.links[link].parent;
  return link == other;
}

// rotation or displacement of each joint of the DOF per unit of the tendon's pull; empty: its
// ratios are kept
std::vector<double> free_motion(const RobotSpec& robot, int dof) {
  std::vector<JointAxis> own;
  for (const JointAxis& axis : axes_of(robot))
    if (axis.joint->dof == dof) own.push_back(axis);
  std::vector<double> out;
  for (size_t j = 0; j < own.size(); ++j) {
    const JointSpec& joint = *own[j].joint;
    double torque = 0;
    for (size_t i = j; i < own.size(); ++i)
      if (beyond(robot, own[i].link, own[j].link))
        torque += own[i].joint->ratio * own[i].axis.dot(own[j].axis);
    out.push_back(torque / joint.spring);
    const bool its_way = torque * joint.ratio > 0 && std::isfinite(out.back());
    if (joint.kind != own.front().joint->kind || !(joint.spring > 0) || !its_way) return {};
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
    for (LinkSpec& link : robot.links)
      for (JointSpec& joint : link.joints) {
        if (joint.dof != dof) continue;
        if (next == 0) first = joint.ratio / free[0];
        joint.ratio = first * free[next++];
      }
  }
}

}  // namespace clench
