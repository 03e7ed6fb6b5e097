#include "clench/contact/patch_width.h"

#include <algorithm>
#include <cmath>

#include "clench/contact/outline.h"

namespace clench {

using Eigen::Vector2d;

// fraction of a width: an angle to an axis that is so small counts as zero
static constexpr double across_slack = 1e-6;

PatchWidth patch_width(const PatchSheet& sheet, bool is_a) {
  PatchWidth out;
  const double mirror = is_a ? -1 : 1;
  std::vector<Vector2d> points;
  for (const int t : sheet.triangles())
    for (const auto& p : sheet.corners(t)) points.emplace_back(p.x(), mirror * p.y());
  const std::vector<int> hull = outline(points, 0);
  for (size_t k = 0; k < hull.size(); ++k) {
    const Vector2d side = points[hull[(k + 1) % hull.size()]] - points[hull[k]];
    if (side.isZero(0)) continue;
    const Vector2d across = Vector2d(side.y(), -side.x()).normalized();
    double low = across.dot(points[hull[0]]), high = low;
    for (const int i : hull) {
      low = std::min(low, across.dot(points[i])), high = std::max(high, across.dot(points[i]));
    }
    out.directions.push_back(across), out.half_widths.push_back((high - low) / 2);
  }
  return out;
}

PatchWidth operator+(PatchWidth one, const PatchWidth& other) {
  one.directions.insert(one.directions.end(), other.directions.begin(), other.directions.end());
  one.half_widths.insert(one.half_widths.end(), other.half_widths.begin(), other.half_widths.end());
  return one;
}

std::array<double, 2> make_room(const PatchWidth& room, const Eigen::Matrix2d& axes,
                                const std::array<double, 2>& semi_axes, bool grows) {
  double part = 1;
  for (size_t i = 0; i < room.directions.size(); ++i) {
    const Vector2d d = axes.transpose() * room.directions[i];
    const double width = std::hypot(semi_axes[0] * d.x(), semi_axes[1] * d.y());
    if (part * width > room.half_widths[i]) part = room.half_widths[i] / width;
  }
  if (part == 1) return semi_axes;
  std::array<double, 2> out = {part * semi_axes[0], part * semi_axes[1]};
  for (int axis = 0; axis < 2 && grows; ++axis) {
    double longest = semi_axes[axis];
    for (size_t i = 0; i < room.directions.size(); ++i) {
      const Vector2d d = axes.transpose() * room.directions[i];
      const double most = (1 + across_slack) * room.half_widths[i];
      const double other = out[1 - axis] * d[1 - axis];
      const double rest = std::sqrt(std::max(0.0, most * most - other * other));
      if (std::abs(d[axis]) * longest > rest) longest = rest / std::abs(d[axis]);
    }
    out[axis] = std::max(out[axis], longest);
  }
  return out;
}

}  // namespace clench
