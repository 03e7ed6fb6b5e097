// Contacts of round pieces: of a cylinder along a line, on its cap or at one point of its rim.
#pragma once
#include <vector>

#include "clench/contact/touch.h"
#include "clench/geometry/query/round_pairs.h"

namespace clench {

/// contact_set() of two shapes, at least one of which has pieces that are treated as round for the
/// purpose `where`. Parts that overlap by more than the inner radius of a round piece have no
/// points.
std::vector<Touch> round_contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                                     RoundIn where, const TouchOptions& options);

}  // namespace clench
