// Nearest points of several triangles to one point at once, in double precision. For the queries of
// this module only. Includes no Eigen: it may be compiled for the machine at hand.
#pragma once
#include "clench/geometry/tree/lanes.h"

namespace clench {

/// So many triangles are judged at once: few points have more that may be the nearest.
inline constexpr int point_step = 2;

/// Corner k of triangle i at [k][i]: three coordinates. Lanes without a triangle repeat another.
struct CornerLanes {
  const double* at[3][point_step];
};

struct alignas(32) NearestToPoint {
  double squared[point_step];  ///< distance [m^2]
  double q[3][point_step];     ///< on the triangle
};

/// point_triangle of each, to the bit.
void nearest_to_point(const double p[3], const CornerLanes& triangles, NearestToPoint& out);

}  // namespace clench
