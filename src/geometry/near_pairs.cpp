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
  std::vector<NearPair> near;
  find_pairs_within(placement.trees(), threshold, near);
  std::vector<TrianglePair> out;
  placement.measure(near, [&](const NearPair& pair, const Closest& c) {
    if (c.distance < threshold)
      out.push_back({pair.triangle_a, pair.triangle_b, c.distance, c.p, c.q});
  });
  std::sort(out.begin(), out.end(), [](const TrianglePair& x, const TrianglePair& y) {
    return std::tie(x.triangle_a, x.triangle_b) < std::tie(y.triangle_a, y.triangle_b);
  });
  return out;
}

}  // namespace clench
