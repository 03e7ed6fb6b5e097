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

const Vector2d& PatchRays::direction(int ray) {
  static const auto directions = [] {
    std::array<Vector2d, count> out;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
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
    const Vector2d turned = PatchRays::direction(k);
    const Vector2d d = turned.x() * first + turned.y() * second;
    rays.directions[k] = d;
    // to where it leaves the last disc about a site
    const auto leaves = [&](double r) {
      double length = 0;
      for (const Vector2d& site : sites) {
        const double along = d.dot(site), room = r * r - site.squaredNorm() + along * along;
        if (room > 0) length = std::max(length, along + std::sqrt(room));
      }
      return length;
    };
    rays.lengths[k] = leaves(radius), rays.known[k] = leaves(PatchSheet::reach * radius);
  }
  return rays;
}

// --- heights ---

static double flat_cross(const Vector2d& u, const Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

// From where to where a ray from the origin runs over a triangle; false where it does not.
static bool clip_ray(const std::array<Vector2d, 3>& p, const Vector2d& direction, double& from,
                     double& to) {
  // all on one side: most triangles of a fine mesh
  const double a = flat_cross(direction, p[0]), b = flat_cross(direction, p[1]),
               c = flat_cross(direction, p[2]);
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
      double from = 0, to = rays.known[k];
      if (!clip_ray(flat, rays.directions[k], from, to)) continue;
      out.rim[k] = std::max(out.rim[k], to);
      if (from > length) continue;
      to = std::min(to, length);
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

RayLengths ray_rim(const PatchSheet& sheet, const PatchRays& rays) {
  RayLengths out = {};
  for (const int t : sheet.triangles()) {
    const Corners& c = sheet.corners(t);
    const std::array<Vector2d, 3> flat = {c[0].head<2>(), c[1].head<2>(), c[2].head<2>()};
    for (int k = 0; k < PatchRays::count; ++k) {
      double from = 0, to = rays.known[k];
      if (clip_ray(flat, rays.directions[k], from, to)) out[k] = std::max(out[k], to);
    }
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
    const double curvature = curvatures.cwiseMax(0).dot(PatchRays::direction(k).cwiseAbs2());
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

Matrix2d star_moments(const RayLengths& corners) {
  // by the triangles between the middle and the sides
  double area = 0;
  Matrix2d moments = Matrix2d::Zero();
  for (int k = 0; k < PatchRays::count; ++k) {
    const int next = (k + 1) % PatchRays::count;
    const Vector2d p = corners[k] * PatchRays::direction(k),
                   q = corners[next] * PatchRays::direction(next), sum = p + q;
    const double part = 0.5 * (p.x() * q.y() - p.y() * q.x());
    area += part;
    moments += part / 12 * (p * p.transpose() + q * q.transpose() + sum * sum.transpose());
  }
  if (!(area > 0)) return Matrix2d::Zero();
  return moments / area;
}

Matrix2d overlap(const GapProfile& profile, double depth) {
  RayLengths rim;
  for (int k = 0; k < PatchRays::count; ++k) rim[k] = ray_reach(profile, k, depth);
  return star_moments(rim);
}

// --- pressing ---

// of depths below a straight line of gaps from one place of a ray to the next, in its sector
static double slice_volume(double from, double to, double gap_from, double gap_to, double depth) {
  constexpr double sector = 2 * std::numbers::pi / PatchRays::count;
  if (gap_from > gap_to) {
    // the deep end is the far one
    if (depth <= gap_to) return 0;
    if (depth < gap_from)
      from = to - (to - from) * (depth - gap_to) / (gap_from - gap_to), gap_from = depth;
  } else {
    if (depth <= gap_from) return 0;
    if (depth < gap_to)
      to = from + (to - from) * (depth - gap_from) / (gap_to - gap_from), gap_to = depth;
  }
  // linear times r: exact
  const double one = depth - gap_from, two = depth - gap_to, width = to - from;
  return sector * width * (one * (2 * from + to) + two * (from + 2 * to)) / 6;
}

// of depths over where two surfaces meet [m^3]
static double meeting_volume(const GapProfile& profile, double depth) {
  double sum = 0;
  for (int k = 0; k < PatchRays::count; ++k) {
    const auto& gap = profile.gap.height[k];
    const double length = profile.rays.lengths[k];
    for (int i = 0; i + 1 < PatchRays::places; ++i) {
      if (gap[i] == no_height) continue;
      const double from = length * PatchRays::part(i);
      double to = length * PatchRays::part(i + 1), gap_to = gap[i + 1];
      // the surface ends before the next place, which it reaches level
      if (gap_to == no_height) to = std::clamp(profile.gap.end[k], from, to), gap_to = gap[i];
      sum += slice_volume(from, to, gap[i], gap_to, depth);
    }
  }
  return sum;
}

std::optional<double> depth_of(const GapProfile& profile, double volume) {
  if (!(volume > 0)) return 0;
  double highest = 0;
  for (const auto& row : profile.gap.height)
    for (const double gap : row)
      if (gap < no_height) highest = std::max(highest, gap);
  // below all gaps the volume grows by the area
  const double full = meeting_volume(profile, highest);
  const double area = (meeting_volume(profile, 2 * highest + 1) - full) / (highest + 1);
  if (!(area > 0)) return std::nullopt;
  if (volume >= full) return highest + (volume - full) / area;
  double low = 0, high = highest;
  for (int round = 0; round < 100 && low < high; ++round) {
    const double middle = 0.5 * (low + high);
    (meeting_volume(profile, middle) < volume ? low : high) = middle;
  }
  return high;
}

}  // namespace clench
