#include "contact/patch_rim.h"

#include <algorithm>
#include <cmath>

namespace clench {

using Eigen::Matrix2d;
using Eigen::Vector2d;

bool PatchRim::any_ended() const {
  for (int k = 0; k < PatchRays::count; ++k)
    if (ended(k)) return true;
  return false;
}

PatchRim patch_rim(const RayLengths& a, const RayLengths& b, const RayLengths& looked) {
  PatchRim rim{{}, looked};
  for (int k = 0; k < PatchRays::count; ++k) rim.ends[k] = std::min({a[k], b[k], looked[k]});
  return rim;
}

double rim_angle(const PatchRim& rim) {
  // as far on all sides, so that what was looked at has no direction of its own
  const double reach = *std::min_element(rim.looked.begin(), rim.looked.end());
  RayLengths ends = rim.ends;
  for (double& end : ends) end = std::min(end, reach);
  const Matrix2d moments = star_moments(ends);
  return 0.5 * std::atan2(2 * moments(0, 1), moments(0, 0) - moments(1, 1));
}

// half of how wide the star of the ends is along a unit direction
static double half_width(const PatchRim& rim, const Vector2d& direction) {
  double low = 0, high = 0;
  for (int k = 0; k < PatchRays::count; ++k) {
    const double at = rim.ends[k] * PatchRays::direction(k).dot(direction);
    low = std::min(low, at), high = std::max(high, at);
  }
  return (high - low) / 2;
}

RimEllipse make_room(const PatchRim& rim, const std::array<double, 2>& semi_axes) {
  RimEllipse out{semi_axes, true};
  auto& [a, b] = out.semi_axes;
  a = std::min(a, half_width(rim, {1, 0})), b = std::min(b, half_width(rim, {0, 1}));
  double part = 1;
  const auto bound = [&](const Vector2d& d) {
    const double width = std::hypot(a * d.x(), b * d.y()), most = half_width(rim, d);
    if (width > most) part = std::min(part, most / width);
  };
  // where a star is narrow, it is so across one of its sides
  for (int k = 0; k < PatchRays::count; ++k) {
    const int next = (k + 1) % PatchRays::count;
    const Vector2d side =
        rim.ends[next] * PatchRays::direction(next) - rim.ends[k] * PatchRays::direction(k);
    bound(PatchRays::direction(k));
    if (!side.isZero(0)) bound(Vector2d(-side.y(), side.x()).normalized());
  }
  a *= part, b *= part;
  if (out.semi_axes == semi_axes) return out;
  for (int k = 0; k < PatchRays::count; ++k) out.sure = out.sure && rim.ended(k);
  return out;
}

}  // namespace clench
