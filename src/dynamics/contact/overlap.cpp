#include "clench/dynamics/contact/overlap.h"

#include <vector>

namespace clench {

std::optional<Pose> moved_out(const Shape& a, const Shape& b, const Pose& X_AB, double threshold) {
  std::vector<Eigen::Vector3d> ways;
  const Eigen::Vector3d apart = X_AB * b.center() - a.center();
  for (const auto& axes :
       {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), X_AB.rotation.toRotationMatrix()})
    for (int k = 0; k < 3; ++k) {
      const double side = axes.col(k).dot(apart) < 0 ? -1 : 1;
      ways.push_back(side * axes.col(k)), ways.push_back(-side * axes.col(k));
    }
  if (apart.norm() > threshold) ways.push_back(apart.normalized());
  const auto gap_at = [&](const Pose& X, double limit) {
    return signed_distance(a, b, X, RoundIn::motion, limit).distance;
  };
  const auto at = [&](const Eigen::Vector3d& way, double s) {
    return Pose{X_AB.rotation, X_AB.position + s * way};
  };
  for (double s = threshold / 2; s <= deepest_parted * threshold; s *= 4) {
    std::optional<Pose> best;
    double least = 2 * s;
    for (const Eigen::Vector3d& way : ways) {
      double here = s, gap = gap_at(at(way, here), 2 * s + threshold);
      if (!(gap > 0)) continue;
      // moved back by an amount that surely leaves a gap
      for (int i = 0; i < 20 && gap > 0.8 * threshold; ++i) {
        here -= gap - threshold / 2;
        gap = gap_at(at(way, here), 2 * s + threshold);
      }
      if (gap > 0 && gap <= threshold && here < least) least = here, best = at(way, here);
    }
    if (best) return best;
  }
  return std::nullopt;
}

}  // namespace clench
