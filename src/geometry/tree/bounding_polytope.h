// A polytope with few corners that contains a mesh: if two of them are disjoint the meshes are,
// which is a fast test. Single precision, about the tree's center; includes no Eigen.
#pragma once
#include "clench/geometry/tree/lanes.h"

namespace clench {

/// Points side by side; unused lanes repeat the first.
struct alignas(32) PointBundle {
  float at[3][lane_count];
};

struct BoundingPolytope {
  static constexpr int max_bundles = 16;
  static constexpr int max_corners = max_bundles * lane_count;

  /// All are within 1.8 r of the center, r the tree's radius. By rounding, u = 2^-24, the mesh may
  /// extend 16 u r beyond them.
  PointBundle corners[max_bundles];
  int bundles = 0;  ///< number of points in use, the first ones
};

struct FarPoint {
  Triple<float> at;
  float height;  ///< its product with the direction
};

/// The point farthest along n.
/// count  of bundles, at least one
template <class F>
CLENCH_INLINE FarPoint farthest_point(const PointBundle* bundles, int count,
                                      const Triple<float>& n) {
  const auto height_of = [&](const PointBundle& points) {
    return dot(Triple<F>{F::load(points.at[0]), F::load(points.at[1]), F::load(points.at[2])}, n);
  };
  F most = height_of(bundles[0]), number = F::all(0);
  for (int i = 1; i < count; ++i) {
    const F height = height_of(bundles[i]);
    number = select(height > most, F::all(static_cast<float>(i)), number);
    most = max(height, most);
  }
  float numbers[lane_count];
  number.store(numbers);
  const float height = -min_of(-most);
  const int lane = __builtin_ctz(~(most < height).set() & 0xff);
  const auto& at = bundles[static_cast<int>(numbers[lane])].at;
  return {{at[0][lane], at[1][lane], at[2][lane]}, height};
}

}  // namespace clench
