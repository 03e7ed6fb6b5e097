#include "clench/contact/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "clench/base/disjoint_sets.h"
#include "clench/base/watched.h"
#include "clench/contact/cone.h"
#include "clench/contact/outline.h"

namespace clench {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Indices = std::vector<int>;

// a corner this near, in merge radii, to the line between its neighbors is omitted
static constexpr double flat_corner = 0.01;

void join_neighbors(std::vector<NearPoint>& points, double reach) {
  const bool one = std::all_of(points.begin(), points.end(),
                               [&](const NearPoint& p) { return p.region == points[0].region; });
  if (one || !(reach > 0)) return;

  // points by the cube of space that contains them
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

  // the lowest of all linked regions represents them
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

// Within a region the closest point collects all those whose normals agree with its own; then the
// closest of the rest, and so on.
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

// The outline of a patch, thinned, with the closest point first. If the gap is constant up to
// rounding, a corner is as close as any other point.
static Indices reduce(std::vector<NearPoint>& points, const Indices& patch, double merge, int most,
                      double rounding) {
  const NearPoint& closest = points[patch[0]];
  const Eigen::Matrix3d frame = contact_frame(closest.normal);
  std::vector<Vector2d> flat;
  for (const int i : patch) {
    const Vector3d middle = 0.5 * (points[i].p_a + points[i].p_b) - closest.p_a;
    flat.emplace_back(frame.col(0).dot(middle), frame.col(1).dot(middle));
  }
  const double same_place = std::max(flat_corner * merge, rounding);
  const Indices corners = outline(flat, same_place);

  int first = 0;
  for (const int corner : corners) {
    if (points[patch[corner]].gap > closest.gap + rounding) continue;
    // the same point, found from another triangle: the closest pair itself is kept
    if ((flat[corner] - flat[0]).norm() <= same_place) {
      first = 0;
      break;
    }
    if (first == 0) first = corner;
  }
  points[patch[first]].gap = closest.gap;

  Indices kept;
  for (const int k : spread(flat, first, corners, merge, most)) {
    // where edges lie above each other several points share that corner, and some of their gaps run
    // obliquely from edge to edge: the smallest gap is used
    int nearest = k;
    for (int i = 0; i < static_cast<int>(flat.size()); ++i)
      if (points[patch[i]].gap < points[patch[nearest]].gap - rounding &&
          (flat[i] - flat[k]).norm() <= same_place)
        nearest = i;
    if (std::ranges::find(kept, patch[nearest]) == kept.end()) kept.push_back(patch[nearest]);
  }
  return kept;
}

Indices patch_corners(std::vector<NearPoint>& points, double merge, int max_per_patch,
                      double rounding) {
  Indices kept;
  for (const Indices& patch : find_patches(points)) {
    const Indices some = reduce(points, patch, merge, max_per_patch, rounding);
    kept.insert(kept.end(), some.begin(), some.end());
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace clench
