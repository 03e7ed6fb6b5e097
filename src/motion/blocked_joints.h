// Which joints of a robot would push a contact in.
#pragma once
#include <set>
#include <vector>

#include "clench/model/carrying.h"
#include "clench/model/find.h"

namespace clench {

/// A contact blocks a motion that leans into it by more than this sine.
constexpr double grazing = 1e-6;

using JointSpeeds = std::vector<double>;  ///< one per joint [rad or m per unit of path]

struct BlockedJoints {
  std::set<int> joints;
  std::vector<BodyPair> pairs;  ///< whose contacts block; link first
};

/// bodies  of the robot
/// speeds  a joint at 0 is never blocked
/// touching  contacts of these bodies
/// A contact that all joints together lead apart blocks none. Of the others, each blocks the joints
/// that alone would move one body into the other. A gap below `closed` [m] blocks also what would
/// merely slide.
BlockedJoints blocked_joints(const World& world, Id<Robot> robot, const CarriedBodies& bodies,
                             const JointSpeeds& speeds, std::span<const Contact> touching,
                             double closed);

/// How fast the contact's body moves against the other at their point, one joint at unit speed: 0
/// when the joint moves neither or both.   frames  of the robot, in the world;   returns  world
/// axes [m per unit of the joint]
Eigen::Vector3d contact_velocity(const Robot& robot, const CarriedBodies& bodies,
                                 const RobotFrames& frames, int joint, const Contact& contact);

}  // namespace clench
