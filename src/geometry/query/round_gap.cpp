#include "clench/geometry/query/round_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clench {

using Eigen::Vector3d;

namespace {

// Minimum on [low, high] of a function that decreases and then increases; slope_at(x) is its slope.
template <class SlopeAt>
double minimum_by_slope(double low, double high, SlopeAt&& slope_at) {
  constexpr int max_iterations = 200;
  double below = slope_at(low), above = slope_at(high);
  if (below >= 0) return low;
  if (above <= 0) return high;
  // regula falsi that halves the slope at the end it keeps (Illinois), and bisection every third
  // step
  for (int i = 0; i < max_iterations && high - low > 1e-15 * (std::abs(low) + std::abs(high));
       ++i) {
    double x = low + (high - low) * (-below / (above - below));
    if (i % 3 == 2 || !(x > low && x < high)) x = low + (high - low) / 2;
    if (!(x > low && x < high)) break;
    const double slope = slope_at(x);
    if (slope == 0) return x;
    if (slope < 0) {
      low = x, below = slope;
      above /= 2;
    } else {
      high = x, above = slope;
      below /= 2;
    }
  }
  return low + (high - low) / 2;
}

// From the middle of a capsule to the upper end of its axis.
Vector3d axis_end(const PlacedRound& capsule) {
  return capsule.X.rotation * Vector3d(0, 0, capsule.solid.half);
}

void keep_nearer(NearPlace& best, const NearPlace& place) {
  if (place.distance < best.distance) best = place;
}

}  // namespace

NearPlace nearest_on_segment(const PlacedRound& round, const Vector3d& p, const Vector3d& q) {
  if (round.solid.is_ball()) {
    const Closest c = segment_segment(round.X.position, round.X.position, p, q);
    return round.nearest_to(c.q);
  }
  const Vector3d way = q - p;
  if (way.isZero(0)) return round.nearest_to(p);
  if (round.solid.kind == Round::capsule) {
    const Vector3d end = axis_end(round);
    const Closest c = segment_segment(round.X.position - end, round.X.position + end, p, q);
    return round.nearest_to(c.q);
  }
  const Pose into = round.X.inverse();
  const Vector3d from = into * p, along = into.rotation * way;
  const double s = minimum_by_slope(
      0, 1, [&](double t) { return nearest(round.solid, from + t * along).normal.dot(along); });
  return round.nearest_to(p + s * way);
}

// A nearest point inside the triangle lies straight below the solid's extreme point. If the plane
// cuts the solid, the point is taken from the segment between the solid's two extreme points.
NearPlace nearest_on_triangle(const PlacedRound& round, const Corners& triangle) {
  if (round.solid.is_ball()) return round.nearest_to(point_triangle(round.X.position, triangle).q);
  if (round.solid.kind == Round::capsule) {
    const Vector3d end = axis_end(round);
    const Vector3d from = round.X.position - end, to = round.X.position + end;
    return round.nearest_to(triangle_triangle({from, to, to}, triangle).q);
  }
  NearPlace best;
  for (int k = 0; k < 3; ++k)
    keep_nearer(best, nearest_on_segment(round, triangle[k], triangle[(k + 1) % 3]));
  const Vector3d normal =
      (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
  if (normal.isZero()) return best;
  const auto height = [&](const Vector3d& p) { return normal.dot(p - triangle[0]); };
  const Vector3d up = height(round.center()) < 0 ? Vector3d(-normal) : normal;
  const Vector3d low = round.farthest(-up);
  const double gap = up.dot(low - triangle[0]);
  Vector3d foot = low - gap * up;
  if (gap < 0) {
    const Vector3d high = round.farthest(up);
    foot = low + gap / up.dot(low - high) * (high - low);
  }
  for (int k = 0; k < 3; ++k)
    if ((triangle[(k + 1) % 3] - triangle[k]).cross(foot - triangle[k]).dot(normal) < 0)
      return best;
  keep_nearer(best, gap > 0 ? NearPlace{gap, foot, -up} : round.nearest_to(foot));
  return best;
}

namespace {

RoundGap swapped(const RoundGap& gap) { return {gap.gap, gap.p_b, gap.p_a, -gap.normal}; }

// The gap between a and a point of b's surface or solid.
RoundGap gap_at(const NearPlace& place) {
  return {place.distance, place.point - place.distance * place.normal, place.point, place.normal};
}

// The gap between a and a capsule b: from the axis of b, minus its radius.
RoundGap gap_of_capsule(const PlacedRound& a, const PlacedRound& b) {
  const double radius = b.solid.radii.x();
  const Vector3d end = axis_end(b);
  const NearPlace place = nearest_on_segment(a, b.X.position - end, b.X.position + end);
  return {place.distance - radius, place.point - place.distance * place.normal,
          place.point - radius * place.normal, place.normal};
}

// The point nearest to a on the rim of a cylinder b at z = height.
NearPlace nearest_on_rim(const PlacedRound& a, const PlacedRound& b, double height) {
  constexpr int samples = 24;
  constexpr double step = 2 * std::numbers::pi / samples;
  const double radius = b.solid.radii.x();
  const auto at = [&](double angle) {
    return b.X * Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
  };
  int best = 0;
  std::array<double, samples> distances;
  for (int i = 0; i < samples; ++i) {
    distances[i] = a.nearest_to(at(i * step)).distance;
    if (distances[i] < distances[best]) best = i;
  }
  // searches beside the best sample, and beside others that are farther by no more than one step
  NearPlace out;
  for (int i = 0; i < samples; ++i) {
    const double before = distances[(i + samples - 1) % samples],
                 after = distances[(i + 1) % samples];
    if (distances[i] > before || distances[i] > after) continue;
    if (distances[i] > distances[best] + step * radius) continue;
    const double angle = minimum_by_slope((i - 1) * step, (i + 1) * step, [&](double t) {
      const Vector3d tangent = b.X.rotation * Vector3d(-std::sin(t), std::cos(t), 0);
      return a.nearest_to(at(t)).normal.dot(tangent);
    });
    keep_nearer(out, a.nearest_to(at(angle)));
  }
  return out;
}

// The nearest point of a cylinder lies on a rim, inside a cap straight above the extreme point of
// the other solid, or on the side at the height of the axis point.
RoundGap gap_of_cylinder(const PlacedRound& a, const PlacedRound& b) {
  const double radius = b.solid.radii.x(), half = b.solid.half;
  NearPlace best;
  const Vector3d axis = b.X.rotation * Vector3d::UnitZ();
  for (const double side : {-1.0, 1.0}) {
    keep_nearer(best, nearest_on_rim(a, b, side * half));
    const Vector3d outward = side * axis, cap = b.X.position + half * outward;
    const Vector3d extreme = a.farthest(-outward);
    const double height = outward.dot(extreme - cap);
    const Vector3d foot = extreme - height * outward;
    if (outward.dot(a.center() - cap) > 0 && (foot - cap).norm() <= radius)
      keep_nearer(best, height > 0 ? NearPlace{height, foot, -outward} : a.nearest_to(foot));
  }
  const NearPlace middle =
      nearest_on_segment(a, b.X.position - half * axis, b.X.position + half * axis);
  keep_nearer(best, middle);
  constexpr double abreast = 1e-7;
  if (std::abs(middle.normal.dot(axis)) <= abreast) {
    const double along = axis.dot(middle.point - b.X.position);
    if (std::abs(along) < half)
      keep_nearer(best,
                  {middle.distance - radius, middle.point - radius * middle.normal, middle.normal});
  }
  if (best.distance <= 0) return gap_at(best);
  // a solid that pierces a cap may touch neither rim nor axis
  const Vector3d end = a.X.rotation * core_of(a.solid).end;
  const NearPlace pierced = nearest_on_segment(b, a.X.position - end, a.X.position + end);
  return pierced.distance < 0 ? swapped(gap_at(pierced)) : gap_at(best);
}

// Separation of two ellipsoids along n, from a into b; its maximum over all n is their gap.
double gap_along(const PlacedRound& a, const PlacedRound& b, const Vector3d& n) {
  return n.dot(b.farthest(-n) - a.farthest(n));
}

// Newton's method for the direction of the largest separation, which points from one extreme point
// to the other.
RoundGap gap_of_ellipsoids(const PlacedRound& a, const PlacedRound& b) {
  Vector3d n = (b.center() - a.center()).stableNormalized();
  if (n.isZero()) n = Vector3d::UnitZ();
  const auto shape = [](const PlacedRound& round) -> Eigen::Matrix3d {
    const Eigen::Matrix3d R = round.X.matrix();
    return R * round.solid.radii.cwiseAbs2().asDiagonal() * R.transpose();
  };
  const Eigen::Matrix3d A = shape(a), B = shape(b);
  // second derivative of sqrt(v' S v)
  const auto curvature = [](const Eigen::Matrix3d& S, const Vector3d& v) -> Eigen::Matrix3d {
    const Vector3d Sv = S * v;
    const double h = std::sqrt(v.dot(Sv));
    return S / h - Sv * Sv.transpose() / (h * h * h);
  };
  double gap = gap_along(a, b, n);
  for (int i = 0; i < 200; ++i) {
    const Vector3d between = b.farthest(-n) - a.farthest(n);
    const Vector3d slope = between - n.dot(between) * n;
    if (slope.norm() <= 1e-14 * (a.solid.radii.maxCoeff() + b.solid.radii.maxCoeff())) break;
    // Newton's step on the sphere: the gap has curvature -H, minus its own size
    Eigen::Matrix3d H = curvature(A, n) + curvature(B, n);
    H += gap * (Eigen::Matrix3d::Identity() - n * n.transpose()) + n * n.transpose();
    Vector3d step = H.ldlt().solve(slope);
    step -= n.dot(step) * n;
    if (!(step.dot(slope) > 0)) step = slope / (A.trace() + B.trace());
    bool better = false;
    for (int half = 0; half < 40 && !better; ++half, step /= 2) {
      const Vector3d next = (n + step).normalized();
      const double there = gap_along(a, b, next);
      if (there > gap) n = next, gap = there, better = true;
    }
    if (!better) break;
  }
  const Vector3d p_a = a.farthest(n);
  return {gap, p_a, p_a + gap * n, n};
}

}  // namespace

RoundGap gap_between(const PlacedRound& a, const PlacedRound& b) {
  if (b.solid.kind == Round::capsule) return gap_of_capsule(a, b);
  if (a.solid.kind == Round::capsule) return swapped(gap_of_capsule(b, a));
  if (b.solid.kind == Round::cylinder) {
    const RoundGap gap = gap_of_cylinder(a, b);
    // an overlap of two cylinders may show in only one of the two orders
    if (gap.gap <= 0 || a.solid.kind != Round::cylinder) return gap;
    const RoundGap back = swapped(gap_of_cylinder(b, a));
    return back.gap < gap.gap ? back : gap;
  }
  if (a.solid.kind == Round::cylinder) return swapped(gap_of_cylinder(b, a));
  return gap_of_ellipsoids(a, b);
}

}  // namespace clench
