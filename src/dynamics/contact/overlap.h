// Contacts of bodies that were placed into each other, or exactly against each other.
#pragma once
#include <optional>

#include "clench/geometry/query/round_pairs.h"

namespace clench {

inline constexpr double deepest_parted =
    128;  ///< contact thresholds: bodies deeper in each other are left as they are

/// Where b would stand if it were moved straight out of a, on a short way along an axis of either
/// or away from a's centre, until less than the threshold is between them; none where no such way
/// of up to deepest_parted thresholds leads out. Round pieces count by their formulas.
/// threshold  > 0 [m]
std::optional<Pose> moved_out(const Shape& a, const Shape& b, const Pose& X_AB, double threshold);

}  // namespace clench
