// Which joints of a robot move which bodies, those of robots that it carries among them.
#pragma once
#include <vector>

#include "clench/model/world.h"

namespace clench {

/// The link of the robot that the body is, or that carries it; -1: the base, or none.
int carrying_link(const World& world, Id<Robot> robot, Id<Body> body);

/// Does the joint move the body? A body of a carried robot moves with the link that carries it.
bool joint_moves(const World& world, Id<Robot> robot, int joint, Id<Body> body);

/// The robot's bodies that its joints can move, and those of all robots that it carries.
std::vector<Id<Body>> movable_bodies(const World& world, Id<Robot> robot);

}  // namespace clench
