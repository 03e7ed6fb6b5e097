#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.h"
#include "geometry/placement.h"
#include "geometry/queries.h"

namespace clench {

std::vector<TrianglePair> pairs_within(const Shape& a, const Shape& b, const Pose& X_AB,
                                       double threshold) {
  if (std::isnan(threshold))
    fail("pairs_within: threshold must be a number [m], got {}", threshold);
  const Placement placement(a, b, X_AB);
  std::vector<TrianglePair> out;
  for_near_pairs(placement.trees(), Reach{threshold}, [&](int triangle_a, int triangle_b) {
    const Closest c =
        triangle_triangle(placement.corners_a(triangle_a), placement.corners_b(triangle_b));
    if (c.distance < threshold) out.push_back({triangle_a, triangle_b, c.distance, c.p, c.q});
    return false;
  });
  std::sort(out.begin(), out.end(), [](const TrianglePair& x, const TrianglePair& y) {
    return std::tie(x.triangle_a, x.triangle_b) < std::tie(y.triangle_a, y.triangle_b);
  });
  return out;
}

}  // namespace clench
