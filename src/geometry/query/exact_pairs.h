// Nearest points of eight pairs of triangles at once, in double precision. For triangle.h and the
// queries of this module only. Includes no Eigen: it may be compiled for the host's instruction
// set.
#pragma once
#include <limits>

namespace clench {

/// rounding error of a projection, relative to the length of the axis and the extent of what is
/// projected
inline constexpr double projection_rounding = 64 * std::numeric_limits<double>::epsilon();

/// Corners relative to a common origin nearby: coordinate m of corner k of pair i at [3 k + m][i].
struct alignas(64) PairBundle {
  double a[9][8], b[9][8];
};

/// Nearest points of boundaries, and of corners above faces: the distance of disjoint triangles.
struct alignas(64) NearestBundle {
  double squared[8];
  double p[3][8], q[3][8];  ///< on the first, on the second
  unsigned apart;           ///< bit i: the direction from p to q separates pair i, beyond rounding
};

/// Maximum number of lanes processed at once: lanes up to a multiple of it must contain numbers.
inline constexpr int nearest_step = 4;

/// results of the first `count` pairs; the rest of `out` is meaningless
void nearest_of(const PairBundle& pairs, int count, NearestBundle& out);

}  // namespace clench
