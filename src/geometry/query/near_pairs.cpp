#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/geometry/query/placement.h"
#include "clench/geometry/query/queries.h"

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
  // numbers of triangles are not negative
  const auto key = [](const NearPair& pair) {
    return uint64_t{static_cast<uint32_t>(pair.triangle_a)} << 32 |
           static_cast<uint32_t>(pair.triangle_b);
  };
  StopCheck check(1 << 16);
  std::sort(near.begin(), near.end(), [&](const NearPair& x, const NearPair& y) {
    check();
    return key(x) < key(y);
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
