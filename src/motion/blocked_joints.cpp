#include "clench/motion/blocked_joints.h"

#include <algorithm>
#include <cmath>

namespace clench {

// minimum lever of a joint that a contact blocks, 1 nm [m per rad]
static constexpr double no_lever = 1e-9;

Eigen::Vector3d contact_velocity(const Robot& robot, const CarriedBodies& bodies,
                                 const RobotFrames& frames, int joint, const Contact& contact) {
  const bool moves_body = bodies.moved_by(joint, contact.body);
  if (moves_body == bodies.moved_by(joint, contact.other)) return Eigen::Vector3d::Zero();
  return (moves_body ? 1 : -1) * frames.velocity(robot, joint, contact.p_W);
}

namespace {

/// Effect of one joint on a contact.
struct Share {
  int joint;
  bool moves_body;  ///< false: it moves the other body
  double leaving;   ///< separating speed of the contact [m per unit of path]
  double margin;    ///< separating speeds below this count as zero
};

}  // namespace

// effects of the joints that move one side of the contact but not the other
static std::vector<Share> shares_of(const Robot& robot, const CarriedBodies& bodies,
                                    const RobotFrames& frames, const JointSpeeds& speeds,
                                    const Contact& contact) {
  std::vector<Share> shares;
  for (int j = 0; j < static_cast<int>(speeds.size()); ++j) {
    if (speeds[j] == 0) continue;
    const bool moves_body = bodies.moved_by(j, contact.body);
    if (moves_body == bodies.moved_by(j, contact.other)) continue;
    const Eigen::Vector3d v = speeds[j] * contact_velocity(robot, bodies, frames, j, contact);
    shares.push_back({j, moves_body, v.dot(contact.n_W),
                      std::max(grazing * v.norm(), no_lever * std::abs(speeds[j]))});
  }
  return shares;
}

BlockedJoints blocked_joints(const World& world, Id<Robot> id, const CarriedBodies& bodies,
                             const JointSpeeds& speeds, std::span<const Contact> touching,
                             double closed) {
  const auto frames = world.frames(id);
  BlockedJoints out;
  std::set<BodyPair> seen;
  for (const Contact& contact : touching) {
    const auto pushes = [&](double leaving, double margin) {
      return leaving < (contact.gap <= closed ? margin : -margin);
    };
    const auto shares = shares_of(world.robot(id), bodies, frames, speeds, contact);
    double leaving = 0, margin = 0;
    for (const Share& share : shares) leaving += share.leaving, margin += share.margin;
    if (!pushes(leaving, margin)) continue;
    for (const Share& share : shares) {
      if (!pushes(share.leaving, share.margin)) continue;
      out.joints.insert(share.joint);
      const BodyPair pair = share.moves_body ? BodyPair(contact.body, contact.other)
                                             : BodyPair(contact.other, contact.body);
      if (seen.insert(std::minmax(pair.first, pair.second)).second) out.pairs.push_back(pair);
    }
  }
  return out;
}

}  // namespace clench
