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
  if (placement.clearly_apart(threshold)) return {};
  std::vector<NearPair> near;
  near.reserve(64);
  find_pairs_within(placement.trees(), threshold, near);
  std::sort(near.begin(), near.end(), [](const NearPair& x, const NearPair& y) {
    return std::tie(x.triangle_a, x.triangle_b) < std::tie(y.triangle_a, y.triangle_b);
  });
  std::vector<TrianglePair> out;
  out.reserve(near.size());
  placement.measure(near, [&](const NearPair& pair, const Closest& c) {
    if (c.distance < threshold)
      out.push_back({pair.triangle_a, pair.triangle_b, c.distance, c.p, c.q});
  });
  return out;
}

}  // namespace clench
