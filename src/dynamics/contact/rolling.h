// How round bodies roll on where they touch.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// By how much the gap at a point changes in a time of h [s] beyond what the velocities of the two
/// material points say: the point that touches wanders over a round piece while it turns. Negative
/// where the gap closes; 0 of a ball that turns about its centre, and of bodies that are not round
/// there [m].
double rolled_gap(const World& world, const Manifold& manifold, const ManifoldPoint& point,
                  double h);

}  // namespace clench
