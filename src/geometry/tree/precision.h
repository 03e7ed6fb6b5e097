// Precision of a traversal, and the error of its bounds. For the traversals only.
#pragma once
#include <limits>

#include "clench/geometry/tree/lanes.h"

namespace clench {

/// extent  of a query: no coordinate in it is larger [m]
/// sizes   sum of the radii of the trees in it
/// Single precision if it resolves parts of the trees, and no product of four lengths overflows.
CLENCH_INLINE bool single_is_enough(double extent, double sizes) {
  return extent > 1e-4 && extent < 1e6 && extent < 256 * sizes;
}

/// Maximum amount by which a bound may be too large, computed in Real. See box_lanes.h and
/// triangle_lanes.h.
template <class Real>
CLENCH_INLINE Real slack_of(double extent, double sizes, double rounding) {
  constexpr double stored = 0x1p-24, computed = std::numeric_limits<Real>::epsilon() / 2;
  return static_cast<Real>((64 * (computed * extent + stored * sizes) + rounding) * (1 + 0x1p-20));
}

/// No less than x, in Real.
template <class Real>
CLENCH_INLINE Real at_least(double x) {
  return static_cast<Real>(x) * (1 + (x < 0 ? -1 : 1) * 2 * std::numeric_limits<Real>::epsilon());
}

}  // namespace clench
