#include "model/robot.h"

namespace clench {

double joint_value(const Robot& robot, int chain, int joint) {
  const Chain& c = robot.chains[chain];
  if (c.apart[joint]) return *c.apart[joint];
  return c.joints[joint].ratio * robot.q[c.joints[joint].dof];
}

// frame after a joint in the frame of its axis
static Pose joint_motion(const JointSpec& joint, double q) {
  const bool turns = joint.kind == JointKind::revolute;
  const double theta = turns ? joint.theta + q : joint.theta;
  const double d = turns ? joint.d : joint.d + q;
  const Eigen::Quaterniond about_z(Eigen::AngleAxisd(theta, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond about_x(Eigen::AngleAxisd(joint.alpha, Eigen::Vector3d::UnitX()));
  const Pose dh{about_z * about_x, {joint.a * std::cos(theta), joint.a * std::sin(theta), d}};
  return joint.placed_freely ? dh * joint.X_after : dh;
}

Pose joint_pose(const JointSpec& joint, double q) {
  const Pose motion = joint_motion(joint, q);
  return joint.placed_freely ? joint.X_before * motion : motion;
}

std::vector<ChainFrames> chain_frames(const Robot& robot) {
  std::vector<ChainFrames> all;
  all.reserve(robot.chains.size());
  for (int c = 0; c < static_cast<int>(robot.chains.size()); ++c) {
    const Chain& chain = robot.chains[c];
    ChainFrames frames{.start = chain.X_BC, .axes = {}, .after = {}, .links = {}};
    if (chain.parent_chain >= 0)
      frames.start = all[chain.parent_chain].links[chain.parent_link] * chain.X_BC;
    Pose at = frames.start;
    for (int j = 0; j < static_cast<int>(chain.joints.size()); ++j) {
      const JointSpec& joint = chain.joints[j];
      if (joint.placed_freely) at = at * joint.X_before;
      frames.axes.push_back(at);
      at = at * joint_motion(joint, joint_value(robot, c, j));
      frames.after.push_back(at);
    }
    for (size_t l = 0; l < chain.links.size(); ++l) {
      const int last = chain.last_joints[l];
      const Pose& joint = last < 0 ? frames.start : frames.after[last];
      frames.links.push_back(chain.X_JL[l] ? joint * *chain.X_JL[l] : joint);
    }
    all.push_back(std::move(frames));
  }
  return all;
}

bool joint_moves_link(const Robot& robot, int joint_chain, int joint, int chain, int link) {
  while (chain > joint_chain) {
    const Chain& c = robot.chains[chain];
    chain = c.parent_chain;
    link = c.parent_link;
  }
  return chain == joint_chain && robot.chains[chain].last_joints[link] >= joint;
}

}  // namespace clench
