#include "clench/spec/robot_spec.h"

#include <cmath>
#include <limits>

#include "clench/base/error.h"

namespace clench {

Pose approach_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  const double length = direction.stableNorm();
  if (!point.allFinite() || !std::isfinite(length) || length < 1e-9)
    fail("approach direction: expected a direction, got ({}, {}, {})", direction.x(), direction.y(),
         direction.z());
  const Eigen::Vector3d z = direction / length;
  const Eigen::Vector3d x0 =
      std::abs(z.x()) > 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = z.cross(x0).normalized();
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  return {Eigen::Quaterniond(axes).normalized(), point};
}

std::array<double, 2> dof_range(const RobotSpec& robot, int dof) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  const bool endless = dof_is_endless(robot, dof);
  each_joint(robot, [&](const JointSpec& joint) {
    // joints without stops do not limit the range
    if (joint.dof != dof || joint.endless != endless) return;
    const double a = joint.min / joint.ratio, b = joint.max / joint.ratio;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  });
  // a DOF without joints keeps its value
  if (!std::isfinite(low)) return {0, 0};
  return {low, high};
}

bool dof_is_endless(const RobotSpec& robot, int dof) {
  bool moves = false, stops = false;
  each_joint(robot, [&](const JointSpec& joint) {
    if (joint.dof == dof) moves = true, stops = stops || !joint.endless;
  });
  return moves && !stops;
}

bool dof_slides(const RobotSpec& robot, int dof) {
  std::optional<JointKind> first;
  each_joint(robot, [&](const JointSpec& joint) {
    if (!first && joint.dof == dof) first = joint.kind;
  });
  return first == JointKind::prismatic;
}

Pose joint_motion(const JointSpec& joint, double q) {
  if (joint.kind == JointKind::prismatic) return Pose::translation(q * joint.axis);
  return Pose::turn(q, joint.axis);
}

Pose link_in_parent(const LinkSpec& link, const std::vector<double>& q) {
  Pose X;
  for (const JointSpec& joint : link.joints)
    X = X * joint.X_PJ * joint_motion(joint, joint.ratio * q[joint.dof]);
  return X * link.X_JL;
}

std::vector<Pose> link_poses(const RobotSpec& robot, const std::vector<double>& q) {
  std::vector<Pose> poses;
  poses.reserve(robot.links.size());
  for (const LinkSpec& link : robot.links)
    poses.push_back((link.parent < 0 ? Pose{} : poses[link.parent]) * link_in_parent(link, q));
  return poses;
}

std::string no_range(const std::array<double, 2>& range) {
  return fmt::format("expected a range that all of its joints allow, got from {:.6g} to {:.6g}",
                     range[0], range[1]);
}

}  // namespace clench
