#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/containment.h"
#include "geometry/queries.h"
#include "geometry/tree.h"

namespace clench {

Distance distance(const Shape& a, const Shape& b, const Pose& X_AB, double limit,
                  PairCache* cache) {
  if (std::isnan(limit)) fail("distance: limit must be a number [m], got {}", limit);
  const Placement placement(a, b, X_AB);

  // the least over all pairs that can be nearer than the best so far; a bound above 0 lets meeting
  // pairs in whatever the limit
  Distance best;
  best.distance = std::numeric_limits<double>::infinity();
  Reach reach{std::max(limit, std::numeric_limits<double>::min())};
  const auto visit = [&](int triangle_a, int triangle_b) {
    const Corners corners_a = placement.corners_a(triangle_a);
    const Corners corners_b = placement.corners_b(triangle_b);
    if (placement.beyond(corners_a, corners_b, reach)) return false;
    const Closest c = triangle_triangle(corners_a, corners_b);
    // of equally near pairs the first in the order of triangles, so that the way here does not show
    const bool first =
        c.distance == best.distance &&
        std::pair(triangle_a, triangle_b) < std::pair(best.triangle_a, best.triangle_b);
    if (c.distance < reach.distance || first) {
      best = {c.distance, c.p, c.q, triangle_a, triangle_b};
      reach = {c.distance, (c.q - c.p).stableNormalized()};
    }
    return reach.distance == 0;
  };
  const auto try_again = [&](int triangle_a, int triangle_b) {
    return a.has_triangle(triangle_a) && b.has_triangle(triangle_b) &&
           visit(triangle_a, triangle_b);
  };
  // the last closest pair bounds the search; a pair that meets says nothing of which is found first
  if (cache && try_again(cache->closest_a, cache->closest_b)) {
    best = {};
    best.distance = std::numeric_limits<double>::infinity();
    reach = {std::max(limit, std::numeric_limits<double>::min())};
  }
  const bool met = placement.for_near_pairs(reach, visit);
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
