// How far a hand is from everything but what it grasps, and how deep it is in what it grasps.
#pragma once
#include "clench/model/find.h"

namespace clench {

/// Least distance of a hand's bodies from all obstacles and from all objects but `object`; 0 when
/// they collide, infinite when there is nothing else [m]. Switched-off pairs are measured too.
double clearance(const World& world, Id<Robot> hand, Id<Body> object);

/// The deepest that a corner of one lies inside the other, over the bodies of the hand that collide
/// with the object [m]; 0 when none does, or where only edges cross. A lower bound of how far they
/// must move to part. Open meshes hold no corners.
double penetration(const World& world, Id<Robot> hand, Id<Body> object);

}  // namespace clench
