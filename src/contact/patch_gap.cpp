#include "contact/patch_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/patch_points.h"

namespace clench {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

static constexpr double no_height = std::numeric_limits<double>::infinity();

double PatchRays::part(int place) {
  static const auto parts = [] {
    std::array<double, places> out = {};
    for (int i = 1; i < places; ++i) out[i] = std::exp2(0.5 * (i - (places - 1)));
    return out;
  }();
  return parts[place];
}

// unit, in the plane whose x is the first ray
static const Vector2d& ray_direction(int ray) {
  static const auto directions = [] {
    std::array<Vector2d, PatchRays::count> out;
    for (int k = 0; k < PatchRays::count; ++k) {
      const double angle = 2 * std::numbers::pi * k / PatchRays::count;
      out[k] = Vector2d(std::cos(angle), std::sin(angle));
    }
    return out;
  }();
  return directions[ray];
}

PatchRays patch_rays(const Vector2d& first, std::span<const Vector2d> sites, double radius) {
  PatchRays rays;
  const Vector2d second(-first.y(), first.x());
  for (int k = 0; k < PatchRays::count; ++k) {
    const Vector2d turned = ray_direction(k);
    const Vector2d d = turned.x() * first + turned.y() * second;
    rays.directions[k] = d;
    // to where it leaves the last disc about a site
    for (const Vector2d& site : sites) {
      const double along = d.dot(site), room = radius * radius - site.squaredNorm() + along * along;
      if (room > 0) rays.lengths[k] = std::max(rays.lengths[k], along + std::sqrt(room));
    }
  }
  return rays;
}

// --- heights ---

static double flat_cross(const Vector2d& u, const Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

// From where to where a ray from the origin runs over a triangle; false where it does not.
static bool clip_ray(const std::array<Vector2d, 3>& p, const Vector2d& direction, double& from,
                     double& to) {
  // all on one side: most triangles of a fine mesh
  const double a = flat_cross(direction, p[0]), b = flat_cross(direction, p[1]), c = flat_cross(direction, p[2]);
  if ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0)) return false;
  const double turn = flat_cross(p[1] - p[0], p[2] - p[0]) < 0 ? -1 : 1;
  for (int k = 0; k < 3; ++k) {
    const Vector2d edge = turn * (p[(k + 1) % 3] - p[k]);
    // inside from where `rise` times the distance reaches `level`
    const double rise = flat_cross(edge, direction), level = flat_cross(edge, p[k]);
    if (rise > 0) from = std::max(from, level / rise);
    if (rise < 0) to = std::min(to, level / rise);
    if (rise == 0 && level > 0) return false;
  }
  return from <= to;
}

RayHeights ray_heights(PatchSheet& sheet, const PatchRays& rays) {
  std::array<std::array<PatchHit, PatchRays::places>, PatchRays::count> hits;
  RayHeights out;
  for (const int t : sheet.triangles()) {
    const Corners& c = sheet.corners(t);
    const std::array<Vector2d, 3> flat = {c[0].head<2>(), c[1].head<2>(), c[2].head<2>()};
    for (int k = 0; k < PatchRays::count; ++k) {
      const double length = rays.lengths[k], margin = 1e-9 * length;
      double from = 0, to = length;
      if (!clip_ray(flat, rays.directions[k], from, to)) continue;
      out.end[k] = std::max(out.end[k], to);
      for (int i = 0; i < PatchRays::places; ++i) {
        const double r = length * PatchRays::part(i);
        if (r < from - margin) continue;
        if (r > to + margin) break;
        Vector3d weights;
        if (weights_over(c, r * rays.directions[k], weights)) hits[k][i].offer(sheet, t, weights);
      }
    }
  }
  for (int k = 0; k < PatchRays::count; ++k)
    for (int i = 0; i < PatchRays::places; ++i) {
      const PatchHit& hit = hits[k][i];
      out.height[k][i] =
          hit.triangle < 0 ? no_height : sheet.round_point(hit.triangle, hit.weights).z();
    }
  return out;
}

// --- gaps ---

GapProfile gap_profile(const PatchRays& rays, const RayHeights& a, const RayHeights& b) {
  GapProfile out{rays, {}};
  double least = no_height;
  for (int k = 0; k < PatchRays::count; ++k) {
    out.gap.end[k] = std::min(a.end[k], b.end[k]);
    for (int i = 0; i < PatchRays::places; ++i) {
      out.gap.height[k][i] = a.height[k][i] + b.height[k][i];
      least = std::min(least, out.gap.height[k][i]);
    }
  }
  if (least == no_height) return out;
  for (auto& row : out.gap.height)
    for (double& gap : row) gap -= least;
  return out;
}

GapProfile gap_profile(const PatchRays& rays, const Vector2d& curvatures) {
  static const double steepest =
      std::sqrt(1 - PatchSheet::least_facing * PatchSheet::least_facing);  // sine, where sheets end
  GapProfile out{rays, {}};
  for (int k = 0; k < PatchRays::count; ++k) {
    const double curvature = curvatures.cwiseMax(0).dot(ray_direction(k).cwiseAbs2());
    const double length = rays.lengths[k];
    out.gap.end[k] = curvature * length > steepest ? steepest / curvature : length;
    for (int i = 0; i < PatchRays::places; ++i) {
      const double r = length * PatchRays::part(i), sine = curvature * r;
      out.gap.height[k][i] =
          r > out.gap.end[k] ? no_height : sine * r / (1 + std::sqrt(1 - sine * sine));
    }
  }
  return out;
}

GapProfile cut(GapProfile profile, const GapProfile& other) {
  for (int k = 0; k < PatchRays::count; ++k) {
    double& end = profile.gap.end[k];
    end = std::min(end, other.gap.end[k]);
    for (int i = 0; i < PatchRays::places; ++i)
      if (profile.rays.lengths[k] * PatchRays::part(i) > (1 + 1e-9) * end)
        profile.gap.height[k][i] = no_height;
  }
  return profile;
}

// how far out along a ray the gap is within the depth [m]
static double ray_reach(const GapProfile& profile, int ray, double depth) {
  const auto& gap = profile.gap.height[ray];
  const double length = profile.rays.lengths[ray];
  const auto at = [&](int place) { return length * PatchRays::part(place); };
  int last = PatchRays::places - 1;
  while (last >= 0 && !(gap[last] <= depth)) --last;
  if (last < 0) return 0;
  if (last == PatchRays::places - 1) return length;
  const double from = at(last), to = at(last + 1), rest = depth - gap[last];
  if (gap[last + 1] < no_height) return from + (to - from) * rest / (gap[last + 1] - gap[last]);
  // the surface ends before the next place; until there it goes on as it did
  double reach = to;
  if (last > 0 && gap[last - 1] < gap[last])
    reach = from + (from - at(last - 1)) * rest / (gap[last] - gap[last - 1]);
  return std::clamp(std::min(reach, profile.gap.end[ray]), from, to);
}

Matrix2d overlap(const GapProfile& profile, double depth) {
  std::array<Vector2d, PatchRays::count> rim;
  for (int k = 0; k < PatchRays::count; ++k)
    rim[k] = ray_reach(profile, k, depth) * ray_direction(k);
  // the polygon's, by the triangles between the middle and its sides
  double area = 0;
  Matrix2d moments = Matrix2d::Zero();
  for (int k = 0; k < PatchRays::count; ++k) {
    const Vector2d &p = rim[k], &q = rim[(k + 1) % PatchRays::count], sum = p + q;
    const double part = 0.5 * (p.x() * q.y() - p.y() * q.x());
    area += part;
    moments += part / 12 * (p * p.transpose() + q * q.transpose() + sum * sum.transpose());
  }
  if (!(area > 0)) return Matrix2d::Zero();
  return moments / area;
}

}  // namespace clench
