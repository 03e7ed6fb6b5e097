#include "clench/contact/patch_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "clench/base/watched.h"
#include "clench/contact/near_points.h"
#include "clench/geometry/query/queries.h"

namespace clench {

using Eigen::Vector2d;
using Eigen::Vector3d;

static const double min_smooth = std::cos(40 * std::numbers::pi / 180);  // between neighbors
// around a corner: not a spike
static const double min_round = std::cos(60 * std::numbers::pi / 180);
// If one of two neighbors extends this many times farther from their common edge, it is flat and
// next to a rounded edge, not a chord of a curve.
static constexpr double max_height_ratio = 3;
// fraction of the radius: triangles within it of the nearest distance count as nearest
static constexpr double seed_distance = 1e-3;

namespace {

// triangles near the sites, and the radius around each within which they are complete
struct Neighborhood {
  std::vector<int> triangles, seeds;  // ascending
  std::vector<double> reaches;
};

// Triangles with a point in the ball of any site, ascending; found among those in one ball around
// all sites.
std::vector<int> within_reaches(const Shape& shape, const std::vector<Vector3d>& sites_B,
                                const std::vector<double>& reaches) {
  double farthest = 0;
  for (size_t i = 0; i < sites_B.size(); ++i)
    farthest = std::max(farthest, (sites_B[i] - sites_B[0]).norm() + reaches[i]);
  if (sites_B.size() == 1) return region(shape, sites_B[0], reaches[0]);
  std::vector<int> out = region(shape, sites_B[0], (1 + 1e-12) * farthest);
  std::erase_if(out, [&](int triangle) {
    const Corners corners = shape.mesh().corners(triangle);
    for (size_t i = 0; i < sites_B.size(); ++i)
      for (const Vector3d& corner : corners)
        if ((corner - sites_B[i]).squaredNorm() < (1 - 1e-9) * reaches[i] * reaches[i])
          return false;
    for (size_t i = 0; i < sites_B.size(); ++i)
      if (point_triangle(sites_B[i], corners).distance < reaches[i]) return false;
    return true;
  });
  return out;
}

Neighborhood find_neighborhood(const Shape& shape, const Pose& X_BP,
                               std::span<const Vector3d> sites, double radius) {
  Neighborhood out;
  std::vector<Vector3d> sites_B;
  int nearest = -1;
  for (const Vector3d& site : sites) {
    const Vector3d p_B = X_BP * site;
    const ClosestPoint closest = closest_point(shape, p_B, nearest);
    nearest = closest.triangle;
    sites_B.push_back(p_B);
    out.reaches.push_back(PatchSheet::reach * radius + closest.distance);
    const auto more = region(shape, p_B, closest.distance + seed_distance * radius);
    out.seeds.insert(out.seeds.end(), more.begin(), more.end());
  }
  std::sort(out.seeds.begin(), out.seeds.end());
  out.seeds.erase(std::unique(out.seeds.begin(), out.seeds.end()), out.seeds.end());
  if (!sites_B.empty()) out.triangles = within_reaches(shape, sites_B, out.reaches);
  return out;
}

}  // namespace

PatchSheet::PatchSheet(const Shape& shape, const Pose& X_PB, std::span<const Vector3d> sites,
                       double radius)
    : shape_(shape),
      X_PB_(X_PB),
      X_BP_(X_PB.inverse()),
      sites_(sites.begin(), sites.end()),
      radius_(radius),
      highest_(reach * radius),
      near_(shape.mesh(), {}, X_PB) {
  Neighborhood all = find_neighborhood(shape, X_BP_, sites, radius);
  known_ = std::move(all.triangles), reaches_ = std::move(all.reaches);
  near_ = NearSurface(shape.mesh(), known_, X_PB);
  const int count = static_cast<int>(known_.size());
  for (int t = 0; t < count; ++t) normals_.push_back(face_normal(near_.corners(t)));
  corner_normals_.assign(3 * known_.size(), Vector3d::Zero());
  fans_.resize(near_.corner_count());
  touching_ = 1e-9 * (shape.radius() + shape.center().norm());

  // from the seeds across corners
  std::vector<char> inside(count, 0);
  const auto take = [&](int t) {
    if (inside[t] || facing(t) <= min_facing) return;
    inside[t] = 1, triangles_.push_back(t);
  };
  for (const int seed : all.seeds) take(near_.find(seed));
  StopCheck check(1024);
  for (size_t i = 0; i < triangles_.size(); ++i) {
    check();
    for (int k = 0; k < 3; ++k)
      for (const int slot : near_.at_corner(near_.corner(triangles_[i], k))) take(slot / 3);
  }
  std::sort(triangles_.begin(), triangles_.end());
}

double PatchSheet::facing(int triangle) const {
  const double outward = -normals_[triangle].z();
  if (!shape_.closed()) return std::abs(outward);
  return shape_.solid().volume < 0 ? -outward : outward;
}

static double corner_weight(double twice_area, const Vector3d& one, const Vector3d& two) {
  return twice_area / (one.squaredNorm() * two.squaredNorm());
}

std::vector<PatchSheet::Blade> PatchSheet::blades_at(int triangle, int k) const {
  // are all triangles at the corner known?
  const Vector3d& p = corners(triangle)[k];
  bool known = false;
  for (size_t i = 0; i < sites_.size(); ++i)
    known = known || (p - sites_[i]).norm() < (1 - 1e-6) * reaches_[i];
  if (!known) return far_blades_at(triangle, k);
  std::vector<Blade> out;
  for (const int slot : near_.at_corner(near_.corner(triangle, k))) {
    const int t = slot / 3, l = slot % 3;
    const Corners& c = corners(t);
    const Vector3d one = c[(l + 1) % 3] - c[l], two = c[(l + 2) % 3] - c[l];
    const double twice_area = one.cross(two).norm();
    out.push_back({.triangle = known_[t],
                   .normal = normals_[t],
                   .twice_area = twice_area,
                   .weight = corner_weight(twice_area, one, two),
                   .ends = {near_.corner(t, (l + 1) % 3), near_.corner(t, (l + 2) % 3)}});
  }
  return out;
}

// the same, found by a query of the mesh
std::vector<PatchSheet::Blade> PatchSheet::far_blades_at(int triangle, int k) const {
  check_stop();
  const Vector3d center = shape_.mesh().corners(known_[triangle])[k];
  std::vector<Blade> out;
  std::vector<Vector3d> ends;
  const auto number = [&](const Vector3d& p) {
    for (size_t i = 0; i < ends.size(); ++i)
      if ((p - ends[i]).norm() <= touching_) return static_cast<int>(i);
    ends.push_back(p);
    return static_cast<int>(ends.size()) - 1;
  };
  for (const int u : region(shape_, center, touching_)) {
    const Corners c = shape_.mesh().corners(u);
    for (int l = 0; l < 3; ++l) {
      if ((c[l] - center).norm() > touching_) continue;
      const Vector3d one = c[(l + 1) % 3] - c[l], two = c[(l + 2) % 3] - c[l];
      const double twice_area = one.cross(two).norm();
      out.push_back({.triangle = u,
                     .normal = X_PB_.rotation * face_normal(c),
                     .twice_area = twice_area,
                     .weight = corner_weight(twice_area, one, two),
                     .ends = {number(c[(l + 1) % 3]), number(c[(l + 2) % 3])}});
      break;
    }
  }
  return out;
}

// triangles that share an edge have areas in proportion to their heights over it
bool PatchSheet::linked(const Blade& a, const Blade& b) const {
  const double cosine = a.normal.dot(b.normal);
  const bool beside = a.ends[0] == b.ends[0] || a.ends[0] == b.ends[1] || a.ends[1] == b.ends[0] ||
                      a.ends[1] == b.ends[1];
  return beside && (shape_.closed() ? cosine : std::abs(cosine)) > min_smooth &&
         max_height_ratio * a.twice_area > b.twice_area &&
         max_height_ratio * b.twice_area > a.twice_area;
}

// Weighted over the triangles that are reached from this one around the corner, across smooth
// edges.
Vector3d PatchSheet::make_corner_normal(int triangle, int k) {
  auto& [blades, links] = fans_[near_.corner(triangle, k)];
  if (blades.empty()) {
    blades = blades_at(triangle, k);
    for (int i = 0; i < static_cast<int>(blades.size()); ++i)
      for (int j = 0; j < i; ++j)
        if (linked(blades[i], blades[j])) links.emplace_back(i, j);
  }
  const Vector3d& normal = normals_[triangle];
  for (Blade& blade : blades) {
    const double cosine = blade.normal.dot(normal);
    blade.round = (shape_.closed() ? cosine : std::abs(cosine)) > min_round;
    blade.reached = blade.triangle == known_[triangle];
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [i, j] : links) {
      Blade &a = blades[i], &b = blades[j];
      if (a.reached != b.reached && (a.reached ? b : a).round)
        a.reached = b.reached = changed = true;
    }
  }
  Vector3d sum = Vector3d::Zero();
  for (const Blade& blade : blades) {
    // open surfaces have two outer sides
    const double sense = !shape_.closed() && blade.normal.dot(normal) < 0 ? -1 : 1;
    if (blade.reached) sum += sense * blade.weight * blade.normal;
  }
  return sum.isZero() ? normal : sum.normalized();
}

// normal of the smooth surface at a corner, in either sense
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

std::vector<std::array<Vector3d, 2>> PatchSheet::rim() const {
  std::vector<std::array<Vector3d, 2>> out;
  for (const int t : triangles_)
    for (int k = 0; k < 3; ++k) {
      const auto slots = near_.at_edge(near_.edge(t, k));
      const bool continues = std::any_of(slots.begin(), slots.end(), [&](int slot) {
        return slot / 3 != t && std::binary_search(triangles_.begin(), triangles_.end(), slot / 3);
      });
      if (!continues) out.push_back({corners(t)[k], corners(t)[(k + 1) % 3]});
    }
  return out;
}

// length of a segment near the origin, weighted as in crease_length
static double length_near(const Vector2d& from, const Vector2d& to, double radius) {
  constexpr int samples = 16;
  const Vector2d along = to - from;
  const double length = along.norm();
  if (length == 0) return 0;
  // part of the chord within the radius
  const double foot = -from.dot(along) / length;
  const double room = radius * radius - from.squaredNorm() + foot * foot;
  if (room <= 0) return 0;
  const double low = std::max(0.0, foot - std::sqrt(room));
  const double high = std::min(length, foot + std::sqrt(room));
  if (low >= high) return 0;
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const double s = low + (high - low) * (i + 0.5) / samples;
    sum += std::clamp(2 - 2 * (from + s / length * along).norm() / radius, 0.0, 1.0);
  }
  return sum * (high - low) / samples;
}

double PatchSheet::crease_length() const {
  const auto continues = [&](int t, int k) {
    for (const int slot : near_.at_edge(near_.edge(t, k))) {
      const double cosine = normals_[t].dot(normals_[slot / 3]);
      if (slot / 3 != t && (shape_.closed() ? cosine : std::abs(cosine)) > min_smooth) return true;
    }
    return false;
  };
  std::vector<double> lengths(sites_.size(), 0);
  std::vector<char> seen(near_.edge_count(), 0);
  for (const int t : triangles_)
    for (int k = 0; k < 3; ++k) {
      if (seen[near_.edge(t, k)]++ || continues(t, k)) continue;
      for (size_t i = 0; i < sites_.size(); ++i)
        lengths[i] += length_near((corners(t)[k] - sites_[i]).head<2>(),
                                  (corners(t)[(k + 1) % 3] - sites_[i]).head<2>(), radius_);
    }
  return *std::max_element(lengths.begin(), lengths.end());
}

}  // namespace clench
