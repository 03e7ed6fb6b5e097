#include "clench/contact/facet_touches.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/contact/near_points.h"
#include "clench/contact/patches.h"

namespace clench {

using Eigen::Vector3d;

// cracks are narrower than this fraction of the merge radius
static constexpr double crack_part = 0.1;

void check(const TouchOptions& options) {
  const auto length = [](const char* name, double x) {
    if (!(std::isfinite(x) && x >= 0)) fail("contact set: {} must be >= 0 [m], got {}", name, x);
  };
  length("threshold", options.threshold);
  length("merge_radius", options.merge_radius);
  if (options.max_per_patch < 1)
    fail("contact set: max_per_patch must be >= 1, got {}", options.max_per_patch);
}

// Do both surfaces face outwards at their nearest points? The triangle whose normal is most nearly
// along the gap decides; if none is, the answer is no. Open surfaces have no inside.
static bool clearly_apart(const Shape& a, const Shape& b, const Pose& X_AB,
                          const std::vector<TrianglePair>& pairs, double rounding) {
  double least = pairs[0].distance;
  for (const TrianglePair& pair : pairs) least = std::min(least, pair.distance);

  double front_a = 0, front_b = 0;
  const auto keep_larger = [](double& best, double x) {
    if (std::abs(x) > std::abs(best)) best = x;
  };
  for (const TrianglePair& pair : pairs) {
    if (pair.distance > least + rounding) continue;
    const Vector3d gap = (pair.p_b - pair.p_a).normalized();
    keep_larger(front_a, face_normal(a.mesh().corners(pair.triangle_a)).dot(gap));
    const Vector3d normal_b = face_normal(b.mesh().corners(pair.triangle_b));
    keep_larger(front_b, -(X_AB.rotation * normal_b).dot(gap));
  }
  const auto front = [](const Shape& shape, double x) {
    return !shape.closed() || (shape.solid().volume < 0 ? -x : x) > 1e-3;
  };
  return least > rounding && front(a, front_a) && front(b, front_b);
}

double merge_radius(const Shape& a, const Shape& b, const TouchOptions& options) {
  // largest merge radius, as a fraction of the smaller shape's radius
  constexpr double merge_part = 0.1;
  return std::min(options.merge_radius, merge_part * std::min(a.radius(), b.radius()));
}

std::vector<Touch> facet_contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                                     const TouchOptions& options) {
  const auto pairs = pairs_within(a, b, X_AB, options.threshold);
  const bool meet = std::any_of(pairs.begin(), pairs.end(),
                                [](const TrianglePair& pair) { return pair.distance == 0; });
  const double rounding = 64 * coordinate_rounding(a, b, X_AB);
  if (pairs.empty() || meet) return {};
  if (!clearly_apart(a, b, X_AB, pairs, rounding) && colliding(a, b, X_AB)) return {};

  auto points = near_points(a, b, X_AB, pairs, options.threshold);
  const double merge = std::max(merge_radius(a, b, options), rounding);
  join_neighbors(points, std::min(options.threshold, crack_part * merge));
  std::vector<Touch> touches;
  for (const int i : patch_corners(points, merge, options.max_per_patch, rounding))
    touches.push_back({points[i].p_a, points[i].p_b, points[i].normal, points[i].gap,
                       points[i].feature_a, points[i].feature_b});
  return touches;
}

}  // namespace clench
