#include "clench/geometry/query/containment.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/round_pairs.h"

namespace clench {

bool colliding(const Shape& a, const Shape& b, const Pose& X_AB, PairCache* cache) {
  if (are_round(a, b, RoundIn::all)) return colliding_rounds(a, b, X_AB, cache);
  const Placement placement(a, b, X_AB);
  const auto meet = [&](int triangle_a, int triangle_b) {
    return triangles_meet(placement.corners_a(triangle_a), placement.corners_b(triangle_b));
  };
  if (cache && cache->measured.clear > 0 && cache->measured.shapes == fingerprint(a, b) &&
      motion_bound(b, cache->measured.X_AB, X_AB) < cache->measured.clear)
    return false;
  // pairs that intersected in the last query often still do, earlier ones seldom
  if (cache && a.has_triangle(cache->hit_a) && b.has_triangle(cache->hit_b)) {
    if (meet(cache->hit_a, cache->hit_b)) return true;
    cache->hit_a = cache->hit_b = -1;
  }
  if (placement.clearly_apart(0, cache)) return false;
  const bool hit = for_meeting_pairs(placement.trees(), [&](int triangle_a, int triangle_b) {
    if (!meet(triangle_a, triangle_b)) return false;
    if (cache) cache->hit_a = triangle_a, cache->hit_b = triangle_b;
    return true;
  });
  return hit || find_containment(a, b, placement).has_value();
}

}  // namespace clench
