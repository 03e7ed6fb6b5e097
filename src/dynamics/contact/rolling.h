// Rolling contacts of round bodies.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Change of the gap at a point in a time of h [s] in excess of that of the two material points:
/// the contact point moves over a round piece while it rotates. Negative if the gap closes; 0 for a
/// ball that rotates about its center, and for bodies that are not round there [m].
double rolled_gap(const World& world, const Manifold& manifold, const ManifoldPoint& point,
                  double h);

}  // namespace clench
