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

  // the least over all pairs that can be nearer than the best so far; a bound above 0 lets meeting
  // pairs in whatever the limit
  Distance best;
  Reach reach;
  const auto start = [&] {
    best = {.distance = std::numeric_limits<double>::infinity()};
    reach = {std::max(limit, std::numeric_limits<double>::min())};
  };
  start();
  const auto visit = [&](int triangle_a, int triangle_b) {
    const Closest c =
        triangle_triangle(placement.corners_a(triangle_a), placement.corners_b(triangle_b));
    // of equally near pairs the first in the order of triangles, so that the way here does not show
    const bool first =
        c.distance == best.distance &&
        std::pair(triangle_a, triangle_b) < std::pair(best.triangle_a, best.triangle_b);
    if (c.distance < reach.distance || first) {
      best = {c.distance, c.p, c.q, triangle_a, triangle_b};
      reach = {c.distance, {c.q.x() - c.p.x(), c.q.y() - c.p.y(), c.q.z() - c.p.z()}};
    }
    return reach.distance == 0;
  };
  const auto try_again = [&](int triangle_a, int triangle_b) {
    return a.has_triangle(triangle_a) && b.has_triangle(triangle_b) &&
           visit(triangle_a, triangle_b);
  };
  // the last closest pair bounds the search; a pair that meets says nothing of which is found first
  if (cache && try_again(cache->closest_a, cache->closest_b)) start();
  const bool met = for_near_pairs(placement.trees(), reach, visit);
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
