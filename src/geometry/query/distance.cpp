#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/geometry/query/containment.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/round_pairs.h"

namespace clench {

static constexpr double infinity = std::numeric_limits<double>::infinity();

namespace {

// The smallest distance of the pairs of triangles offered, below a limit.
class NearestPair {
 public:
  explicit NearestPair(double limit) : limit_(limit) { start(); }

  // a reach above 0 admits intersecting pairs for any limit
  void start() {
    best_ = {.distance = infinity};
    reach_ = {std::max(limit_, std::numeric_limits<double>::min())};
  }
  void offer(const NearPair& pair, const Closest& c) {
    // of equally near pairs the first in the order of triangles, so that the order of traversal
    // does not matter
    const bool first =
        c.distance == best_.distance &&
        std::pair(pair.triangle_a, pair.triangle_b) < std::pair(best_.triangle_a, best_.triangle_b);
    if (!(c.distance < reach_.distance || first)) return;
    best_ = {c.distance, c.p, c.q, pair.triangle_a, pair.triangle_b};
    reach_ = {c.distance, {c.q.x() - c.p.x(), c.q.y() - c.p.y(), c.q.z() - c.p.z()}};
  }
  const Distance& best() const { return best_; }
  const Reach& reach() const { return reach_; }

 private:
  double limit_;
  Distance best_;
  Reach reach_;
};

}  // namespace

// Is it certain, from the motion since the last measurement, that the shapes are still farther
// apart than the limit, and not inside each other?
static bool stayed_clear(const Shape& a, const Shape& b, const Pose& X_AB, double limit,
                         const PairCache* cache) {
  if (!cache || cache->measured.shapes != fingerprint(a, b)) return false;
  const double clear = cache->measured.clear - motion_bound(b, cache->measured.X_AB, X_AB);
  return clear > 0 && limit <= clear;
}

static Distance distance_of_round(const Shape& a, const Shape& b, const Pose& X_AB, double limit,
                                  PairCache* cache) {
  if (stayed_clear(a, b, X_AB, limit, cache)) return {.distance = infinity};
  Distance out = signed_distance(a, b, X_AB, RoundIn::all, limit, cache);
  if (out.distance <= 0) {
    out.distance = 0;
    out.p_a = out.p_b = 0.5 * (out.p_a + out.p_b);
  }
  if (cache)
    cache->measured = {fingerprint(a, b), X_AB, std::max(0.0, std::min(out.distance, limit))};
  return out;
}

Distance distance(const Shape& a, const Shape& b, const Pose& X_AB, double limit,
                  PairCache* cache) {
  if (std::isnan(limit)) fail("distance: limit must be a number [m], got {}", limit);
  if (are_round(a, b, RoundIn::all)) return distance_of_round(a, b, X_AB, limit, cache);
  const Placement placement(a, b, X_AB);
  if (stayed_clear(a, b, X_AB, limit, cache)) return {.distance = infinity};
  if (limit < infinity && placement.clearly_apart(limit, cache)) {
    if (cache) cache->measured = {fingerprint(a, b), X_AB, std::max(0.0, limit)};
    return {.distance = infinity};
  }

  NearestPair nearest(limit);
  const auto offer = [&](const NearPair& pair, const Closest& c) { nearest.offer(pair, c); };
  // the last closest pair bounds the search; an intersecting pair does not determine which is found
  // first
  if (cache && a.has_triangle(cache->closest_a) && b.has_triangle(cache->closest_b)) {
    placement.measure({{cache->closest_a, cache->closest_b}}, offer);
    if (nearest.best().distance == 0) nearest.start();
  }
  std::vector<NearPair> near;
  const auto meet = [&](int triangle_a, int triangle_b) {
    const Closest c =
        triangle_triangle(placement.corners_a(triangle_a), placement.corners_b(triangle_b));
    if (c.distance == 0) nearest.offer({triangle_a, triangle_b}, c);
    return c.distance == 0;
  };
  const bool met = find_nearest_pairs(placement.trees(), nearest.reach(), near, meet);
  if (!met) placement.measure(near, offer);
  if (cache) cache->measured = {};
  if (!met) {
    if (const auto inside = find_containment(a, b, placement))
      return {0, inside->point, inside->point, inside->triangle_a, inside->triangle_b};
  }
  const Distance& best = nearest.best();
  if (!cache) return best;
  if (best.triangle_a >= 0) cache->closest_a = best.triangle_a, cache->closest_b = best.triangle_b;
  if (met) {
    cache->hit_a = best.triangle_a, cache->hit_b = best.triangle_b;
    return best;
  }
  if (best.triangle_a >= 0) cache->separation = (best.p_b - best.p_a).normalized();
  // without a pair below the limit all are at least as far
  cache->measured = {fingerprint(a, b), X_AB, std::max(0.0, std::min(best.distance, limit))};
  return best;
}

double distance_bound(const Shape& a, const Shape& b, const Pose& X_AB, double limit, double part,
                      std::array<int, 2>& near) {
  if (are_round(a, b, RoundIn::all))
    return std::clamp(distance(a, b, X_AB, limit).distance, 0.0, limit);
  const Placement placement(a, b, X_AB);
  if (placement.clearly_apart(limit)) return limit;
  double nearest = limit;
  if (near[0] >= 0)
    placement.measure({{near[0], near[1]}}, [&](const NearPair&, const Closest& c) {
      nearest = std::min(nearest, c.distance);
    });
  if (nearest == 0) return 0;
  const auto meet = [&](int triangle_a, int triangle_b) {
    return triangles_meet(placement.corners_a(triangle_a), placement.corners_b(triangle_b));
  };
  const double reach = nearest < limit ? part * nearest : limit;
  const DistanceBound found = bound_distance(placement.trees(), {reach}, part, nearest, meet);
  if (found.pair.triangle_a >= 0) near = {found.pair.triangle_a, found.pair.triangle_b};
  return std::clamp(found.lower, 0.0, limit);
}

}  // namespace clench
