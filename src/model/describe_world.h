// The description of a world in its present state: it is saved, and builds an equal world.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// All that World::hash covers except motion other than the time step (velocities, motors,
/// DynamicSettings), and appearance. If those are as in a new world, build_world makes one of the
/// same hash. Bodies in the order of creation, with all properties given; robots with their DOFs
/// and breakaway states, but without parts that have no effect (tendons, tactile sensors).
WorldSpec describe_world(const World& world);

}  // namespace clench
