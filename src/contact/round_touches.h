// Where round pieces touch: a cylinder along a line, on its cap or at one point of its rim.
#pragma once
#include "clench/contact/contact_set.h"
#include "clench/geometry/query/round_pairs.h"

namespace clench {

/// contact_set() of shapes of which one at least has round pieces there. Where a round piece lies in
/// the other shape, by less than its inner radius, gaps are negative; what overlaps otherwise has
/// no points.
std::vector<Touch> round_contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                                     RoundIn where, const TouchOptions& options = {});

}  // namespace clench
