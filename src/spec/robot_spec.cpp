#include "spec/robot_spec.h"

#include <cmath>
#include <limits>

#include "base/error.h"

namespace clench {

Pose approach_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  const double length = direction.stableNorm();
  if (!point.allFinite() || !std::isfinite(length) || length < 1e-9)
    fail("approach direction: wanted a direction, got ({}, {}, {})", direction.x(), direction.y(),
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
  for (const auto& chain : robot.chains)
    for (const auto& joint : chain.joints) {
      if (joint.dof != dof) continue;
      const double a = joint.min / joint.ratio, b = joint.max / joint.ratio;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
  // a DOF without joints stays where it is
  if (!std::isfinite(low)) return {0, 0};
  return {low, high};
}

static void check_dof(const DofSpec& dof, const std::string& subject) {
  for (const double x :
       {dof.default_velocity, dof.kp, dof.kd, dof.dragger_scale, dof.default_value})
    if (!std::isfinite(x)) fail("{}: wanted finite numbers, got {}", subject, x);
  if (!(dof.max_effort >= 0)) fail("{}: max effort must be >= 0, got {}", subject, dof.max_effort);
  if (!(dof.breakaway_torque >= 0))
    fail("{}: breakaway torque must be >= 0, got {}", subject, dof.breakaway_torque);
}

static void check_joint(const JointSpec& joint, const RobotSpec& robot,
                        const std::string& subject) {
  const int dofs = static_cast<int>(robot.dofs.size());
  if (joint.dof < 0 || joint.dof >= dofs)
    fail("{}: wanted a DOF from 0 to {}, got {}", subject, dofs - 1, joint.dof);
  for (const double x :
       {joint.theta, joint.d, joint.a, joint.alpha, joint.min, joint.max, joint.rest})
    if (!std::isfinite(x)) fail("{}: wanted finite numbers, got {}", subject, x);
  // lengths whose squares and products overflow are no lengths
  for (const double x :
       {joint.theta, joint.d, joint.a, joint.alpha, joint.min, joint.max, joint.rest})
    if (std::abs(x) > 1e30) fail("{}: wanted numbers of at most 1e30, got {}", subject, x);
  if (joint.ratio == 0 || !std::isfinite(joint.ratio))
    fail("{}: wanted a ratio other than 0, got {}", subject, joint.ratio);
  if (joint.min > joint.max)
    fail("{}: min {} exceeds max {} [{}]", subject, joint.min, joint.max,
         joint.kind == JointKind::revolute ? "rad" : "m");
  if (!std::isfinite(joint.max / joint.ratio - joint.min / joint.ratio))
    fail("{}: wanted a ratio that leaves DOF {} a finite range, got {}", subject, joint.dof,
         joint.ratio);
  for (const double x : {joint.viscous, joint.coulomb, joint.spring})
    if (!(x >= 0) || !std::isfinite(x))
      fail("{}: friction and spring must be >= 0, got {}", subject, x);
}

void check_robot(const RobotSpec& robot) {
  for (size_t i = 0; i < robot.dofs.size(); ++i)
    check_dof(robot.dofs[i], fmt::format("{}: DOF {}", robot.name, i));
  for (size_t c = 0; c < robot.chains.size(); ++c) {
    const ChainSpec& chain = robot.chains[c];
    const std::string place = fmt::format("{}: chain {}", robot.name, c);
    if (!chain.X_BC.is_finite()) fail("{}: wanted a finite pose of its base", place);
    for (size_t j = 0; j < chain.joints.size(); ++j)
      check_joint(chain.joints[j], robot, fmt::format("{} joint {}", place, j));
    const int joints = static_cast<int>(chain.joints.size());
    for (size_t l = 0; l < chain.links.size(); ++l)
      if (const int last = chain.links[l].last_joint; last < -1 || last >= joints)
        fail("{} link {}: wanted a last joint from -1 to {}, got {}", place, l, joints - 1, last);
  }
  for (size_t i = 0; i < robot.dofs.size(); ++i)
    if (const auto [low, high] = dof_range(robot, static_cast<int>(i)); low > high)
      fail("{}: DOF {}: the ranges of its joints have no value in common", robot.name, i);
}

}  // namespace clench
