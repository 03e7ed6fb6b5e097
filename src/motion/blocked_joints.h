// Finds the joints of a robot that are blocked by contacts.
#pragma once
#include <set>
#include <vector>

#include "clench/model/carrying.h"
#include "clench/model/find.h"

namespace clench {

/// A contact blocks a motion that points into it by more than this sine.
constexpr double grazing = 1e-6;

using JointSpeeds = std::vector<double>;  ///< one per joint [rad or m per unit of path]

struct BlockedJoints {
  std::set<int> joints;
  std::vector<BodyPair> pairs;  ///< contacts that block; link first
};

/// A contact that the joints together separate blocks none. Each other contact blocks those joints
/// that alone would move one body into the other. A gap below `closed` [m] also blocks joints that
/// would only slide.
///
/// bodies    of the robot
/// speeds    a joint at 0 is never blocked
/// touching  contacts of these bodies
BlockedJoints blocked_joints(const World& world, Id<Robot> robot, const CarriedBodies& bodies,
                             const JointSpeeds& speeds, std::span<const Contact> touching,
                             double closed);

/// Velocity of the contact's body relative to the other at their point, for one joint at unit
/// speed; 0 if the joint moves neither body or both.
/// frames   of the robot, in the world
/// returns  in world axes [m per unit of the joint]
Eigen::Vector3d contact_velocity(const Robot& robot, const CarriedBodies& bodies,
                                 const RobotFrames& frames, int joint, const Contact& contact);

}  // namespace clench
