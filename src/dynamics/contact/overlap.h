// Contacts of bodies that were placed into each other, or exactly against each other.
#pragma once
#include <optional>

#include "clench/geometry/query/round_pairs.h"

namespace clench {

inline constexpr double deepest_parted =
    128;  ///< in contact thresholds: bodies that penetrate deeper are not separated

/// Pose of b after a translation out of a, on a short path along an axis of either or away from a's
/// center, until their gap is below the threshold; none if no such path of up to deepest_parted
/// thresholds separates them. Round pieces are measured by closed formulas.
/// threshold  > 0 [m]
std::optional<Pose> moved_out(const Shape& a, const Shape& b, const Pose& X_AB, double threshold);

}  // namespace clench
