// Corners of a body on a face of another one: as they slide over it, where they touch follows without a search.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// What a manifold that was just measured may rely on while its bodies slide; nothing unless all its points are corners of one
/// body over the inside of one flat face, beyond which the other body does not reach. Bodies of many triangles are not looked at.
std::optional<FlatContact> find_flat_contact(const World& world, const Manifold& manifold);

/// Brings points and gaps to where the pair is now, as measuring it would, up to rounding.
/// returns  false, and leaves all as it was, when another part could touch by now, a corner may have left the face, or one is no
///          more within the threshold, or not above the face
bool follow_flat_contact(const World& world, Manifold& manifold);

}  // namespace clench
