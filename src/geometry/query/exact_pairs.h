// Nearest points of eight pairs of triangles at once, in double precision. For triangle.h and the
// queries of this module only. Includes no Eigen: it may be compiled for the machine at hand.
#pragma once
#include <limits>

namespace clench {

/// of a projection, relative to the length of the axis and the extent of what is projected
inline constexpr double projection_rounding = 64 * std::numeric_limits<double>::epsilon();

/// Corners about a common origin near by: coordinate m of corner k of pair i at [3 k + m][i].
struct alignas(64) PairBundle {
  double a[9][8], b[9][8];
};

/// Of boundaries, and of corners above faces: the distance of triangles that are apart.
struct alignas(64) NearestBundle {
  double squared[8];
  double p[3][8], q[3][8];  ///< on the first, on the second
  unsigned apart;           ///< bit i: the direction from p to q parts pair i, beyond rounding
};

/// So many lanes are judged at once, at most: up to a multiple of it there must be numbers in them.
inline constexpr int nearest_step = 4;

/// of the first `count` pairs; the rest of `out` is of no meaning
void nearest_of(const PairBundle& pairs, int count, NearestBundle& out);

}  // namespace clench
