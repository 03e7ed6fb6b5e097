// The flat part of a placed round solid, and the part of it that is near another body.
#pragma once
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "clench/geometry/query/round_gap.h"

namespace clench {

/// The result of flat_part(), transformed to the frame in which the solid is placed.
struct PlacedFlat {
  FlatPart part;

  PlacedFlat(const PlacedRound& round, const Eigen::Vector3d& direction, double slack);

  /// The point of the flat part straight above or below p, along its normal.
  Eigen::Vector3d above(const Eigen::Vector3d& p) const;
  /// Does p lie over the near part of the disc, along its normal?
  bool over_disc(const Eigen::Vector3d& p) const;
  /// Points of the rim of the near part of the disc: `count` all around, or one more along an arc.
  std::vector<Eigen::Vector3d> rim(int count) const;
  /// The part of the line p + s way that lies over the near part of the disc, or next to the
  /// segment: s from low to high.
  /// returns  false if the line misses it
  bool clip(const Eigen::Vector3d& p, const Eigen::Vector3d& way, double& low, double& high) const;
  /// 1 for a line parallel to the segment, decreasing to 0 at the angle at which clip() begins to
  /// reject lines as too steep; 1 for a disc.
  double alignment(const Eigen::Vector3d& way) const;

 private:
  bool clip_disc(const Eigen::Vector3d& p, const Eigen::Vector3d& way, double& low,
                 double& high) const;
};

/// The near part of a line that runs along a flat part from s = low to high: where gap_at(s), which
/// is convex and has its minimum at `at`, is below the threshold. It shrinks to a point as
/// near_height() says.
/// share   of the near part that is kept, 0 to 1
/// returns  the range of s; empty if no part is near
template <class GapAt>
std::optional<std::pair<double, double>> near_part(double low, double high, double at, double share,
                                                   double threshold, GapAt&& gap_at) {
  constexpr int halvings = 50;
  if (!(high > low)) return std::nullopt;
  at = std::clamp(at, low, high);
  if (!(gap_at(at) < threshold)) return std::nullopt;
  const auto end = [&](double far) {
    if (gap_at(far) < threshold) return far;
    double near = at;
    for (int i = 0; i < halvings; ++i)
      (gap_at((near + far) / 2) < threshold ? near : far) = (near + far) / 2;
    return near;
  };
  const double from = end(low), to = end(high), size = high - low;
  if (!(to > from)) return std::nullopt;
  const double kept = share * near_height(to - from, size) / (to - from);
  if (kept == 0) return std::nullopt;
  if (kept == 1) return std::pair(from, to);
  return std::pair(at + kept * (from - at), at + kept * (to - at));
}

}  // namespace clench
