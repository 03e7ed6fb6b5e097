#include "model/robot.h"

namespace clench {

double joint_value(const Robot& robot, int chain, int joint) {
  const Chain& c = robot.chains[chain];
  if (c.breakaway[joint]) return *c.breakaway[joint];
  return c.joints[joint].ratio * robot.q[c.joints[joint].dof];
}

Pose joint_pose(const JointSpec& joint, double q) {
  const bool turns = joint.kind == JointKind::revolute;
  const double theta = turns ? joint.theta + q : joint.theta;
  const double d = turns ? joint.d : joint.d + q;
  const Eigen::Quaterniond about_z(Eigen::AngleAxisd(theta, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond about_x(Eigen::AngleAxisd(joint.alpha, Eigen::Vector3d::UnitX()));
  return {about_z * about_x, {joint.a * std::cos(theta), joint.a * std::sin(theta), d}};
}

std::vector<Pose> chain_frames(const Robot& robot, int chain) {
  const Chain& c = robot.chains[chain];
  std::vector<Pose> frames{c.X_BC};
  frames.reserve(c.joints.size() + 1);
  for (size_t j = 0; j < c.joints.size(); ++j)
    frames.push_back(frames.back() *
                     joint_pose(c.joints[j], joint_value(robot, chain, static_cast<int>(j))));
  return frames;
}

}  // namespace clench
