// The description of a world as it is now: what is saved, and what builds an equal one.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Everything that World::hash covers but how a world moves beside its time step (velocities,
/// motors, DynamicSettings), and how things look. Where those are as in a new world build_world
/// makes one of the same hash. Bodies in the order of creation, all their properties given; robots
/// with their DOFs and breakaway states, but without what nothing acts on (tendons, tactile
/// sensors).
WorldSpec describe_world(const World& world);

}  // namespace clench
