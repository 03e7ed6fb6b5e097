#include "contact/patch_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/near_points.h"
#include "geometry/queries.h"

namespace clench {

using Eigen::Vector2d;
using Eigen::Vector3d;

static const double least_smooth = std::cos(40 * std::numbers::pi / 180);  // between neighbours
static const double least_round =
    std::cos(60 * std::numbers::pi / 180);  // around a corner: no spike
// Of two neighbours, one that goes on so much farther from their edge is flat beside a rounded edge,
// not a chord of a curve.
static constexpr double most_height_ratio = 3;
static constexpr double seed_distance = 1e-3;  // of the radius: triangles as near as the nearest
// a sphere around a site holds what lies over its disc, slopes of 45 degrees on the whole
static const double patch_reach = std::sqrt(2.0);

namespace {

// what is near the sites, and how far around each it is all there is
struct Neighbourhood {
  std::vector<int> triangles, seeds;  // ascending
  std::vector<double> reaches;
};

void make_unique(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

Neighbourhood find_neighbourhood(const Shape& shape, const Pose& X_BP,
                                 std::span<const Vector3d> sites, double radius) {
  Neighbourhood out;
  const auto add = [](std::vector<int>& to, const std::vector<int>& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  int nearest = -1;
  for (const Vector3d& site : sites) {
    const Vector3d p_B = X_BP * site;
    const ClosestPoint closest = closest_point(shape, p_B, nearest);
    nearest = closest.triangle;
    out.reaches.push_back(patch_reach * radius + closest.distance);
    add(out.triangles, region(shape, p_B, out.reaches.back()));
    add(out.seeds, region(shape, p_B, closest.distance + seed_distance * radius));
  }
  make_unique(out.triangles), make_unique(out.seeds);
  return out;
}

}  // namespace

PatchSheet::PatchSheet(const Shape& shape, const Pose& X_PB, std::span<const Vector3d> sites,
                       double radius)
    : shape_(shape),
      X_PB_(X_PB),
      X_BP_(X_PB.inverse()),
      sites_(sites.begin(), sites.end()),
      highest_(patch_reach * radius),
      near_(shape.mesh(), {}, X_PB) {
  Neighbourhood all = find_neighbourhood(shape, X_BP_, sites, radius);
  known_ = std::move(all.triangles), reaches_ = std::move(all.reaches);
  near_ = NearSurface(shape.mesh(), known_, X_PB);
  const int count = static_cast<int>(known_.size());
  for (int t = 0; t < count; ++t) normals_.push_back(face_normal(near_.corners(t)));
  corner_normals_.assign(3 * known_.size(), Vector3d::Zero());

  // from the seeds on, across corners
  std::vector<char> inside(count, 0);
  const auto take = [&](int t) {
    if (inside[t] || facing(t) <= least_facing) return;
    inside[t] = 1, triangles_.push_back(t);
  };
  for (const int seed : all.seeds) take(near_.find(seed));
  for (size_t i = 0; i < triangles_.size(); ++i)
    for (int k = 0; k < 3; ++k)
      for (const int slot : near_.at_corner(near_.corner(triangles_[i], k))) take(slot / 3);
  std::sort(triangles_.begin(), triangles_.end());
}

double PatchSheet::facing(int triangle) const {
  const double outward = -normals_[triangle].z();
  if (!shape_.closed()) return std::abs(outward);
  return shape_.solid().volume < 0 ? -outward : outward;
}

double PatchSheet::touching() const { return 1e-9 * (shape_.radius() + shape_.centre().norm()); }

// triangles of the mesh with that corner
std::vector<int> PatchSheet::fan(int triangle, int k) const {
  const Vector3d& p = corners(triangle)[k];
  for (size_t i = 0; i < sites_.size(); ++i)
    if ((p - sites_[i]).norm() < (1 - 1e-6) * reaches_[i]) {
      std::vector<int> out;
      for (const int slot : near_.at_corner(near_.corner(triangle, k)))
        out.push_back(known_[slot / 3]);
      return out;
    }
  return region(shape_, shape_.mesh().corners(known_[triangle])[k], touching());
}

// Weighted over the triangles that one comes to from this one around the corner, across edges that
// are none.
Vector3d PatchSheet::make_corner_normal(int triangle, int k) const {
  const Corners own = shape_.mesh().corners(known_[triangle]);
  const Vector3d normal = face_normal(own), &centre = own[k];
  const double touch = touching();
  struct Blade {
    Vector3d one, two, normal;  // its two sides from the corner
    double twice_area;
    bool reached;
  };
  std::vector<Blade> blades;
  for (const int u : fan(triangle, k)) {
    const Corners c = shape_.mesh().corners(u);
    Vector3d n = face_normal(c);
    if (!shape_.closed() && n.dot(normal) < 0) n = -n;
    for (int l = 0; l < 3; ++l) {
      if ((c[l] - centre).norm() > touch) continue;
      const Vector3d one = c[(l + 1) % 3] - c[l], two = c[(l + 2) % 3] - c[l];
      blades.push_back({one, two, n, one.cross(two).norm(), u == known_[triangle]});
      break;
    }
  }
  // beside triangles of one edge the areas are as the heights over it
  const auto smooth = [&](const Blade& from, const Blade& to) {
    if (to.normal.dot(from.normal) <= least_smooth || to.normal.dot(normal) <= least_round ||
        most_height_ratio * to.twice_area <= from.twice_area ||
        most_height_ratio * from.twice_area <= to.twice_area)
      return false;
    for (const Vector3d& p : {from.one, from.two})
      for (const Vector3d& q : {to.one, to.two})
        if ((p - q).norm() <= touch) return true;
    return false;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (const Blade& from : blades)
      for (Blade& to : blades)
        if (from.reached && !to.reached && smooth(from, to)) to.reached = changed = true;
  }
  Vector3d sum = Vector3d::Zero();
  for (const Blade& b : blades)
    if (b.reached) sum += b.normal * (b.twice_area / (b.one.squaredNorm() * b.two.squaredNorm()));
  if (sum.isZero()) sum = normal;
  return X_PB_.rotation * sum.normalized();
}

// of the smooth surface at a corner, in either sense
const Vector3d& PatchSheet::corner_normal(int triangle, int k) {
  Vector3d& n = corner_normals_[3 * triangle + k];
  if (n.isZero()) n = make_corner_normal(triangle, k);
  return n;
}

Vector3d PatchSheet::round_point(int triangle, const Vector3d& weights) {
  const Corners& c = corners(triangle);
  Vector3d q = Vector3d::Zero(), lift = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) q += weights[k] * c[k];
  // half way to the planes through the corners
  for (int k = 0; k < 3; ++k) {
    const Vector3d& n = corner_normal(triangle, k);
    lift += 0.5 * weights[k] * (c[k] - q).dot(n) * n;
  }
  return q + lift;
}

double PatchSheet::crease_distance() const {
  double least = std::numeric_limits<double>::infinity();
  const auto goes_on = [&](int t, int k) {
    for (const int slot : near_.at_edge(near_.edge(t, k))) {
      const double cosine = normals_[t].dot(normals_[slot / 3]);
      if (slot / 3 != t && (shape_.closed() ? cosine : std::abs(cosine)) > least_smooth)
        return true;
    }
    return false;
  };
  for (const int t : triangles_)
    for (int k = 0; k < 3; ++k) {
      if (goes_on(t, k)) continue;
      const Vector3d &p = corners(t)[k], &q = corners(t)[(k + 1) % 3];
      const Vector2d edge = (q - p).head<2>();
      for (const Vector3d& site : sites_) {
        const Vector2d from = (site - p).head<2>();
        const double length_2 = edge.squaredNorm();
        const double part = length_2 > 0 ? std::clamp(from.dot(edge) / length_2, 0.0, 1.0) : 0;
        least = std::min(least, (from - part * edge).norm());
      }
    }
  return least;
}

}  // namespace clench
