#include "clench/geometry/round/round.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clench {

using Eigen::Vector3d;

Core core_of(const Round& round) {
  if (round.kind != Round::ellipsoid) return {.end = {0, 0, round.half}, .around = round.radii.x()};
  int longest = 0;
  round.radii.maxCoeff(&longest);
  Core out;
  out.end[longest] = round.radii[longest];
  out.around = std::max(round.radii[(longest + 1) % 3], round.radii[(longest + 2) % 3]);
  return out;
}

double inner_radius(const Round& round) {
  if (round.kind == Round::ellipsoid) return round.radii.minCoeff();
  return round.kind == Round::capsule ? round.radii.x() : std::min(round.radii.x(), round.half);
}

static NearSkin nearest_of_capsule(const Round& round, const Vector3d& p) {
  const Vector3d away = p - Vector3d(0, 0, std::clamp(p.z(), -round.half, round.half));
  const double length = away.norm();
  return {length - round.radii.x(), length > 0 ? Vector3d(away / length) : Vector3d(1, 0, 0)};
}

static NearSkin nearest_of_cylinder(const Round& round, const Vector3d& p) {
  const double rho = std::hypot(p.x(), p.y());
  const Vector3d outward = rho > 0 ? Vector3d(p.x() / rho, p.y() / rho, 0) : Vector3d(1, 0, 0);
  const Vector3d up(0, 0, p.z() < 0 ? -1 : 1);
  const double side = rho - round.radii.x(), cap = std::abs(p.z()) - round.half;
  if (side <= 0 && cap <= 0) return side > cap ? NearSkin{side, outward} : NearSkin{cap, up};
  if (cap <= 0) return {side, outward};
  if (side <= 0) return {cap, up};
  const double distance = std::hypot(side, cap);
  return {distance, (side * outward + cap * up) / distance};
}

// The nearest point is r_i^2 p_i / (t + r_i^2) for the largest root t of
// sum (r_i p_i / (t + r_i^2))^2 = 1, which Newton's method finds from below: the sum falls and is
// convex.
static NearSkin nearest_of_ellipsoid(const Round& round, const Vector3d& p) {
  // coordinates below this part of the largest semi-axis count as this: the distance changes less
  constexpr double min_coordinate = 1e-13;
  constexpr int max_iterations = 100;
  const Vector3d& r = round.radii;
  const Vector3d squared = r.cwiseAbs2();
  const Vector3d q = p.cwiseAbs().cwiseMax(min_coordinate * r.maxCoeff());
  double t = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) t = std::max(t, r[k] * q[k] - squared[k]);
  for (int i = 0; i < max_iterations; ++i) {
    double value = -1, slope = 0;
    for (int k = 0; k < 3; ++k) {
      const double part = r[k] * q[k] / (t + squared[k]);
      value += part * part;
      slope -= 2 * part * part / (t + squared[k]);
    }
    const double next = t - value / slope;
    if (!(value > 0 && next > t)) break;
    t = next;
  }
  Vector3d on, normal;
  for (int k = 0; k < 3; ++k) {
    const double side = p[k] < 0 ? -1 : 1;
    on[k] = side * squared[k] * q[k] / (t + squared[k]);
    normal[k] = on[k] / squared[k];
  }
  normal.normalize();
  return {(p - on).dot(normal), normal};
}

NearSkin nearest(const Round& round, const Vector3d& p) {
  switch (round.kind) {
    case Round::capsule:
      return nearest_of_capsule(round, p);
    case Round::cylinder:
      return nearest_of_cylinder(round, p);
    default:
      return nearest_of_ellipsoid(round, p);
  }
}

// -1, 0 or 1
static double sign_of(double x) { return (x > 0) - (x < 0); }

Vector3d support(const Round& round, const Vector3d& direction) {
  if (round.kind == Round::ellipsoid) {
    const Vector3d scaled = round.radii.cwiseProduct(direction);
    return round.radii.cwiseProduct(scaled) / scaled.norm();
  }
  const Vector3d end(0, 0, round.half * sign_of(direction.z()));
  if (round.kind == Round::capsule) return end + round.radii.x() * direction;
  const Vector3d aside(direction.x(), direction.y(), 0);
  const double length = aside.norm();
  return length > 0 ? Vector3d(end + round.radii.x() / length * aside) : end;
}

double near_height(double slack, double drop) {
  constexpr double steepest = 4;  // drops, in slacks
  if (slack >= drop) return slack;
  return std::max(0.0, (steepest * slack - drop) / (steepest - 1));
}

// Largest sine of the angle between a flat part and a direction's tangent plane.
static constexpr double max_tilt_sine = 0.5;

static FlatPart flat_disc(const Round& round, const Vector3d& direction, double slack) {
  const double radius = round.radii.x(), aside = std::hypot(direction.x(), direction.y());
  const double drop = 2 * radius * aside, height = near_height(slack, drop);
  if (!(height > 0)) return {.middle = support(round, direction)};
  constexpr double level = 1e-9;
  const Vector3d low =
      aside > level ? Vector3d(direction.x() / aside, direction.y() / aside, 0) : Vector3d(1, 0, 0);
  FlatPart out{.kind = FlatPart::disc, .middle = {0, 0, std::copysign(round.half, direction.z())}};
  out.x = radius * low;
  out.y = radius * Vector3d(-low.y(), low.x(), 0);
  if (height < drop) out.cut = 1 - 2 * height / drop;
  return out;
}

// The line of the side. The ball at the end of a capsule reaches a little farther than it.
static FlatPart flat_side(const Round& round, const Vector3d& direction, double slack) {
  const double radius = round.radii.x(), aside = std::hypot(direction.x(), direction.y()),
               along = std::abs(direction.z());
  const double above = round.kind == Round::capsule ? radius * along * along / (1 + aside) : 0;
  const double drop = 2 * round.half * along, height = near_height(slack - above, drop);
  if (!(height > 0)) return {.middle = support(round, direction)};
  FlatPart out{
      .kind = FlatPart::segment,
      .middle = radius / aside * Vector3d(direction.x(), direction.y(), 0),
      .half = {0, 0, round.half},
  };
  if (!(height < drop)) return out;
  if (direction.z() > 0)
    out.low = 1 - 2 * height / drop;
  else
    out.high = 2 * height / drop - 1;
  return out;
}

FlatPart flat_part(const Round& round, const Vector3d& direction, double slack) {
  if (round.kind != Round::ellipsoid && round.half > 0) {
    if (round.kind == Round::cylinder && std::hypot(direction.x(), direction.y()) <= max_tilt_sine)
      return flat_disc(round, direction, slack);
    if (std::abs(direction.z()) <= max_tilt_sine) return flat_side(round, direction, slack);
  }
  return {.middle = support(round, direction)};
}

}  // namespace clench
