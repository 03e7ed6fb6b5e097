#include "clench/contact/contact_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "clench/base/disjoint_sets.h"
#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/contact/cone.h"
#include "clench/contact/near_points.h"
#include "clench/contact/outline.h"

namespace clench {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Indices = std::vector<int>;

// normals of one flat patch: their cosines, that is 2.6 degrees
static constexpr double same_normal = 1 - 1e-3;
// points of small things merge within this part of their radius, whatever merge_radius says
static constexpr double merge_part = 0.1;
// cracks are narrower than this part of the merge radius
static constexpr double crack_part = 0.1;
// a corner this near, in merge radii, to the line between its neighbours is none
static constexpr double flat_part = 0.01;

static void check(const TouchOptions& options) {
  const auto length = [](const char* name, double x) {
    if (!(std::isfinite(x) && x >= 0)) fail("contact set: {} must be >= 0 [m], got {}", name, x);
  };
  length("threshold", options.threshold);
  length("merge_radius", options.merge_radius);
  if (options.max_per_patch < 1)
    fail("contact set: max_per_patch must be >= 1, got {}", options.max_per_patch);
}

// Are both surfaces seen from outside where they are nearest? The triangle that looks most squarely
// along the gap decides; one that sees nothing says no. Open surfaces have no inside.
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

// --- patches: points of one region and one normal ---

// Regions that come as near as `reach` with the same normal are one: meshes have cracks.
static void join_neighbours(std::vector<NearPoint>& points, double reach) {
  const bool one = std::all_of(points.begin(), points.end(),
                               [&](const NearPoint& p) { return p.region == points[0].region; });
  if (one || !(reach > 0)) return;

  // points by the cube of space that they lie in
  using Cell = std::array<double, 3>;
  const auto cell = [&](const Vector3d& p) {
    return Cell{std::floor(p.x() / reach), std::floor(p.y() / reach), std::floor(p.z() / reach)};
  };
  std::vector<std::pair<Cell, int>> sorted;
  int regions = 0;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    sorted.emplace_back(cell(points[i].p_a), i);
    regions = std::max(regions, points[i].region + 1);
  }
  std::sort(sorted.begin(), sorted.end());

  // the least region of all that are linked stands for them
  DisjointSets linked(regions);
  StopCheck check(4096);
  for (const auto& [home, i] : sorted)
    for (int k = 0; k < 27; ++k) {
      check();
      const Cell next = {home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1};
      auto other = std::lower_bound(sorted.begin(), sorted.end(), std::pair(next, 0));
      for (; other != sorted.end() && other->first == next; ++other) {
        const NearPoint &p = points[i], &q = points[other->second];
        const bool apart = linked.find(p.region) != linked.find(q.region);
        if (apart && (p.p_a - q.p_a).norm() <= reach && p.normal.dot(q.normal) > same_normal)
          linked.join(p.region, q.region);
      }
    }
  for (NearPoint& point : points) point.region = linked.find(point.region);
}

// Within a region the closest point takes all those whose normals agree with its own, and so on.
static std::vector<Indices> find_patches(const std::vector<NearPoint>& points) {
  Indices order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
    return std::pair(points[i].region, points[i].gap) < std::pair(points[j].region, points[j].gap);
  });
  std::vector<Indices> patches;
  for (auto first = order.begin(); first != order.end();) {
    const NearPoint& seed = points[*first];
    const auto end =
        std::find_if(first, order.end(), [&](int i) { return points[i].region != seed.region; });
    while (first != end) {
      const Vector3d normal = points[*first].normal;
      const auto rest = std::stable_partition(
          first + 1, end, [&](int i) { return points[i].normal.dot(normal) > same_normal; });
      patches.emplace_back(first, rest);
      first = rest;
    }
  }
  return patches;
}

// The outline of a patch, thinned; with the closest point, which leads the patch. Where the gap is
// the same all over, up to rounding, a corner is as close as any.
static Indices reduce(std::vector<NearPoint>& points, const Indices& patch, double merge, int most,
                      double rounding) {
  const NearPoint& closest = points[patch[0]];
  const Eigen::Matrix3d frame = contact_frame(closest.normal);
  std::vector<Vector2d> flat;
  for (const int i : patch) {
    const Vector3d middle = 0.5 * (points[i].p_a + points[i].p_b) - closest.p_a;
    flat.emplace_back(frame.col(0).dot(middle), frame.col(1).dot(middle));
  }
  const double same_place = std::max(flat_part * merge, rounding);
  const Indices corners = outline(flat, same_place);

  int first = 0;
  for (const int corner : corners) {
    if (points[patch[corner]].gap > closest.gap + rounding) continue;
    // the same point, seen from another triangle: the closest pair itself stays
    if ((flat[corner] - flat[0]).norm() <= same_place) {
      first = 0;
      break;
    }
    if (first == 0) first = corner;
  }
  points[patch[first]].gap = closest.gap;

  Indices kept;
  for (const int k : spread(flat, first, corners, merge, most)) {
    // of edges that lie above each other several points are that corner, and some run aslant from
    // edge to edge
    int nearest = k;
    for (int i = 0; i < static_cast<int>(flat.size()); ++i)
      if (points[patch[i]].gap < points[patch[nearest]].gap - rounding &&
          (flat[i] - flat[k]).norm() <= same_place)
        nearest = i;
    if (std::ranges::find(kept, patch[nearest]) == kept.end()) kept.push_back(patch[nearest]);
  }
  return kept;
}

std::vector<Touch> contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                               const TouchOptions& options) {
  check(options);
  const auto pairs = pairs_within(a, b, X_AB, options.threshold);
  const bool meet = std::any_of(pairs.begin(), pairs.end(),
                                [](const TrianglePair& pair) { return pair.distance == 0; });
  const double rounding = 64 * coordinate_rounding(a, b, X_AB);
  if (pairs.empty() || meet) return {};
  if (!clearly_apart(a, b, X_AB, pairs, rounding) && colliding(a, b, X_AB)) return {};

  auto points = near_points(a, b, X_AB, pairs, options.threshold);
  const double merge = std::max(
      std::min(options.merge_radius, merge_part * std::min(a.radius(), b.radius())), rounding);
  join_neighbours(points, std::min(options.threshold, crack_part * merge));
  Indices kept;
  for (const Indices& patch : find_patches(points)) {
    const Indices some = reduce(points, patch, merge, options.max_per_patch, rounding);
    kept.insert(kept.end(), some.begin(), some.end());
  }
  std::sort(kept.begin(), kept.end());

  std::vector<Touch> touches;
  for (const int i : kept)
    touches.push_back({points[i].p_a, points[i].p_b, points[i].normal, points[i].gap,
                       points[i].feature_a, points[i].feature_b});
  return touches;
}

}  // namespace clench
