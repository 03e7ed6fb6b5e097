#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/containment.h"
#include "geometry/queries.h"

namespace clench {

Distance distance(const Shape& a, const Shape& b, const Pose& X_AB, double limit,
                  PairCache* cache) {
  if (std::isnan(limit)) fail("distance: limit must be a number [m], got {}", limit);
  const Placement placement(a, b, X_AB);

  // a reach above 0 lets meeting pairs in whatever the limit
  Distance best;
  Reach reach;
  const auto start = [&] {
    best = {.distance = std::numeric_limits<double>::infinity()};
    reach = {std::max(limit, std::numeric_limits<double>::min())};
  };
  start();
  const auto take = [&](const NearPair& pair, const Closest& c) {
    // of equally near pairs the first in the order of triangles, so that the way here does not show
    const std::pair order(pair.triangle_a, pair.triangle_b);
    const bool first =
        c.distance == best.distance && order < std::pair(best.triangle_a, best.triangle_b);
    if (!(c.distance < reach.distance || first)) return;
    best = {c.distance, c.p, c.q, pair.triangle_a, pair.triangle_b};
    reach = {c.distance, {c.q.x() - c.p.x(), c.q.y() - c.p.y(), c.q.z() - c.p.z()}};
  };
  // the last closest pair bounds the search; a pair that meets says nothing of which is found first
  if (cache && a.has_triangle(cache->closest_a) && b.has_triangle(cache->closest_b)) {
    placement.measure({{cache->closest_a, cache->closest_b}}, take);
    if (best.distance == 0) start();
  }
  std::vector<NearPair> near;
  const auto meet = [&](int triangle_a, int triangle_b) {
    const NearPair pair{triangle_a, triangle_b};
    const Closest c =
        triangle_triangle(placement.corners_a(triangle_a), placement.corners_b(triangle_b));
    if (c.distance == 0) take(pair, c);
    return c.distance == 0;
  };
  const bool met = find_near_pairs(placement.trees(), reach, true, near, meet);
  if (!met) placement.measure(near, take);
  if (!met) {
    if (const auto inside = find_containment(a, b, placement))
      return {0, inside->point, inside->point, inside->triangle_a, inside->triangle_b};
  }
  if (cache && best.triangle_a >= 0) {
    cache->closest_a = best.triangle_a, cache->closest_b = best.triangle_b;
    if (met) cache->hit_a = best.triangle_a, cache->hit_b = best.triangle_b;
  }
  return best;
}

}  // namespace clench
