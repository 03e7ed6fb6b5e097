// Nearest points of several triangles to one point at once, in double precision. For the queries of
// this module only. Includes no Eigen: it may be compiled for the host's instruction set.
#pragma once
#include "clench/geometry/tree/lanes.h"

namespace clench {

/// Number of triangles processed at once: few points have more candidates for the nearest.
inline constexpr int point_step = 2;

/// Corner k of triangle i at [k][i]: three coordinates. Unused lanes repeat another triangle.
struct CornerLanes {
  const double* at[3][point_step];
};

struct alignas(32) NearestToPoint {
  double squared[point_step];  ///< distance [m^2]
  double q[3][point_step];     ///< on the triangle
};

/// point_triangle of each, bit-exactly.
void nearest_to_point(const double p[3], const CornerLanes& triangles, NearestToPoint& out);

}  // namespace clench
