// Relative pose of two trees for a traversal. For the traversals only.
#pragma once
#include <cmath>

#include "clench/geometry/tree/lanes.h"
#include "clench/geometry/tree/walk.h"

namespace clench {

/// from the frame of b into that of a
template <class Real>
CLENCH_INLINE Move<Real> move_of(const TreePair& pair) {
  const auto& r = pair.rotation;
  const auto& o = pair.offset;
  const auto real = [](double x) { return static_cast<Real>(x); };
  return {{{real(r[0]), real(r[1]), real(r[2])},
           {real(r[3]), real(r[4]), real(r[5])},
           {real(r[6]), real(r[7]), real(r[8])}},
          {real(o[0]), real(o[1]), real(o[2])}};
}

/// no coordinate of either tree, in the frame of a, is larger [m]
CLENCH_INLINE double extent_of(const TreePair& pair) {
  const double* o = pair.offset;
  return std::sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]) + pair.a->radius() + pair.b->radius();
}

}  // namespace clench
