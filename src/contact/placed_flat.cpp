#include "clench/contact/placed_flat.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clench {

using Eigen::Vector3d;

// Smallest cosine of the angle at which a line still counts as parallel to a segment, and the one
// above which the complete near part is kept.
static constexpr double abreast = 0.5, well_abreast = 0.75;

PlacedFlat::PlacedFlat(const PlacedRound& round, const Vector3d& direction, double slack)
    : part(flat_part(round.solid, round.X.rotation.conjugate() * direction, slack)) {
  part.middle = round.X * part.middle;
  for (Vector3d* v : {&part.half, &part.x, &part.y}) *v = round.X.rotation * *v;
}

Vector3d PlacedFlat::above(const Vector3d& p) const {
  const Vector3d from = p - part.middle;
  if (part.kind == FlatPart::segment)
    return part.middle +
           std::clamp(from.dot(part.half) / part.half.squaredNorm(), -1.0, 1.0) * part.half;
  if (part.kind == FlatPart::disc)
    return part.middle +
           (from.dot(part.x) * part.x + from.dot(part.y) * part.y) / part.x.squaredNorm();
  return part.middle;
}

bool PlacedFlat::over_disc(const Vector3d& p) const {
  const Vector3d from = p - part.middle;
  const double size = part.x.squaredNorm();
  return std::hypot(from.dot(part.x), from.dot(part.y)) <= size &&
         (part.cut == -1 || from.dot(part.x) >= part.cut * size);
}

std::vector<Vector3d> PlacedFlat::rim(int count) const {
  std::vector<Vector3d> out;
  const bool complete = part.cut == -1;
  for (int k = 0; k < (complete ? count : count + 1); ++k) {
    const double angle =
        complete ? 2 * std::numbers::pi * k / count : std::acos(part.cut) * (2.0 * k / count - 1);
    out.push_back(part.middle + std::cos(angle) * part.x + std::sin(angle) * part.y);
  }
  return out;
}

bool PlacedFlat::clip_disc(const Vector3d& p, const Vector3d& way, double& low,
                           double& high) const {
  const Vector3d from = p - part.middle;
  const double size = part.x.squaredNorm();
  const double fx = from.dot(part.x) / size, fy = from.dot(part.y) / size,
               wx = way.dot(part.x) / size, wy = way.dot(part.y) / size;
  const double a = wx * wx + wy * wy, b = fx * wx + fy * wy, c = fx * fx + fy * fy - 1;
  const double under = b * b - a * c;
  if (!(a > 0) || under < 0) return false;
  low = (-b - std::sqrt(under)) / a, high = (-b + std::sqrt(under)) / a;
  if (part.cut == -1) return true;
  if (wx == 0) return fx >= part.cut;
  double& far = wx > 0 ? low : high;
  const double at_cut = (part.cut - fx) / wx;
  far = wx > 0 ? std::max(far, at_cut) : std::min(far, at_cut);
  return low <= high;
}

bool PlacedFlat::clip(const Vector3d& p, const Vector3d& way, double& low, double& high) const {
  if (part.kind == FlatPart::disc) return clip_disc(p, way, low, high);
  const Vector3d from = p - part.middle;
  const double size = part.half.squaredNorm(), speed = way.dot(part.half) / size,
               at = from.dot(part.half) / size;
  if (std::abs(speed) * std::sqrt(size) < abreast * way.norm()) return false;
  low = (-1 - at) / speed, high = (1 - at) / speed;
  if (low > high) std::swap(low, high);
  return true;
}

double PlacedFlat::alignment(const Vector3d& way) const {
  if (part.kind != FlatPart::segment) return 1;
  const double cosine = std::abs(way.dot(part.half)) / (way.norm() * part.half.norm());
  return std::clamp((cosine - abreast) / (well_abreast - abreast), 0.0, 1.0);
}

}  // namespace clench
