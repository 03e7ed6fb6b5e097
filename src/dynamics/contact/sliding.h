// Corners that slide over a flat face: their contact points are updated without a search.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Updates the points and the clearance of a manifold to the present poses of its bodies, with the
/// same result as a measurement up to rounding, if all its points are corners of one body over one
/// face of the other, which is convex, and no other corner has come near.
/// returns  false, and changes nothing, if this does not apply, and for soft bodies
bool follow_sliding(const World& world, Manifold& manifold);

}  // namespace clench
