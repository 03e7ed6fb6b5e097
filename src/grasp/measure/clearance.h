// Distance of a hand from everything but the object that it grasps, and its depth inside that
// object.
#pragma once
#include "clench/model/find.h"

namespace clench {

/// Smallest distance of a hand's bodies from all obstacles and from all objects but `object`; 0 if
/// they collide, infinite if there is nothing else [m]. Switched-off pairs are measured, too.
double clearance(const World& world, Id<Robot> hand, Id<Body> object);

/// The largest distance, from the object's surface, of a point of the hand inside the object [m],
/// as in clench/model/penetration.h: at most 1 um + 0.1 % below the true value, 0 without an
/// overlap.
double penetration(const World& world, Id<Robot> hand, Id<Body> object,
                   const Progress& progress = {});

}  // namespace clench
