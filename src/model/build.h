// A world from its description.
#pragma once
#include "clench/base/listeners.h"
#include "clench/model/find.h"

namespace clench {

/// Bodies and robots in the file's order. A carried robot keeps the pose that its block gives when
/// this agrees with the connection to the six digits that files hold; otherwise the connection
/// wins. DOF values outside their limits are brought to the nearest limit. The listeners are told.
World build_world(const WorldSpec& spec, const Listeners& listeners = {});

/// Switches off the pairs of a robot's own bodies that overlap, or are nearer than `closer_than`
/// [m], where it stands: models whose links reach into each other at a joint could otherwise never
/// move.
/// returns  those pairs
std::vector<BodyPair> switch_off_overlaps(World& world, Id<Robot> robot, double closer_than = 0);

/// Adds a robot, and tells of the pairs that switch_off_overlaps found.
Id<Robot> add_robot(World& world, const RobotSpec& spec, const Pose& X_WB,
                    const std::string& name = "", const Listeners& listeners = {});

}  // namespace clench
