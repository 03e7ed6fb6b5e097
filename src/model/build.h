// Builds a world from its description.
#pragma once
#include "clench/base/diagnostic.h"
#include "clench/model/find.h"

namespace clench {

/// Bodies and robots in the file's order. A carried robot keeps the pose of its block if this
/// agrees with the connection to the six digits of files; otherwise the connection is used. DOF
/// values outside their limits are set to the nearest limit. The diagnostics receive what was
/// inferred or repaired.
World build_world(const WorldSpec& spec, const Diagnostics& diagnostics = {});

/// Disables collisions of the pairs of a robot's own bodies that overlap, or are nearer than
/// `closer_than` [m], in its present posture: models whose links penetrate each other at a joint
/// could otherwise never move.
/// returns  those pairs
std::vector<BodyPair> switch_off_overlaps(World& world, Id<Robot> robot, double closer_than = 0);

/// Adds a robot, and reports the pairs found by switch_off_overlaps.
Id<Robot> add_robot(World& world, const RobotSpec& spec, const Pose& X_WB,
                    const std::string& name = "", const Diagnostics& diagnostics = {});

}  // namespace clench
