// Which joints of a robot move which bodies, those of robots that it carries among them.
#pragma once
#include <utility>
#include <vector>

#include "model/world.h"

namespace clench {

using JointPlace = std::pair<int, int>;  ///< chain, joint

/// The link of the robot that the body is, or that carries it, as {chain, link}; chain -1: the base, or none.
std::pair<int, int> carrying_link(const World& world, Id<Robot> robot, Id<Body> body);

/// Does the joint move the body? A body of a carried robot moves with the last link of the chain that carries it.
bool joint_moves(const World& world, Id<Robot> robot, JointPlace joint, Id<Body> body);

/// The robot's bodies that its joints can move, and those of all robots that it carries.
std::vector<Id<Body>> movable_bodies(const World& world, Id<Robot> robot);

}  // namespace clench
