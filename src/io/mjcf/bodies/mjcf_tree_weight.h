// Poses of the links of an MJCF tree, and their total mass properties as one body.
#pragma once
#include <optional>
#include <vector>

#include "clench/io/mjcf/bodies/mjcf_tree.h"

namespace clench {

/// Pose per link, in the frame of the first, all joints at zero.
std::vector<Pose> tree_poses(const TreeModel& tree);

/// Mass, center of mass and inertia of all links together; empty if that of a link is unknown.
/// X  poses of the links
std::optional<BodySpec> weigh_tree(const MjcfTree& tree, const std::vector<Pose>& X);

/// Fraction of the total weight that is compensated.
double mean_gravity_compensation(const MjcfTree& tree);

}  // namespace clench
