// Corners that slide over a flat face: where they touch follows without a search.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Brings the points and the clearance of a manifold to where its bodies are now, as measuring it
/// would, up to rounding, when all its points are corners of one body over one face of the other,
/// which is convex, and no further corner has come near.
/// returns  false, and leaves all as it was, where it is not so, and between soft bodies
bool follow_sliding(const World& world, Manifold& manifold);

}  // namespace clench
