// Extent of a scene: its center, and its radius as unit of length.
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "clench/base/error.h"
#include "clench/scene/scene.h"

namespace clench {

/// A ball [m].
struct Extent {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;

  /// An eye given in the world, relative to the center and divided by the scale.
  Eye to_scene(const Eye& world) const;
};

/// A ball around the center of bounds, through their farthest point. Squares of lengths do not
/// overflow.
class BallAround {
 public:
  explicit BallAround(const Bounds& bounds)
      : center_(0.5 * bounds.low + 0.5 * bounds.high),
        half_((0.5 * bounds.high - 0.5 * bounds.low).maxCoeff()),
        unit_(1 / half_) {}
  const Eigen::Vector3d& center() const { return center_; }
  /// factor of the measured distances, the reciprocal of half the bounds' size; infinite if it is 0
  double unit() const { return unit_; }
  void add(const Eigen::Vector3d& p) {
    if (std::isfinite(unit_)) most_ = std::max(most_, (unit_ * (p - center_)).squaredNorm());
  }
  /// square of the distance of the farthest point so far, times unit() squared
  double farthest() const { return most_; }
  /// throws  Error if it exceeds the range of numbers
  Extent extent() const {
    const double scale = half_ * std::sqrt(most_);
    if (!std::isfinite(scale)) fail("picture: the size of the scene exceeds the range of numbers");
    // a single point is seen from a distance that its coordinates can resolve
    return {center_, std::max(scale, 1e-9 * std::max(1.0, center_.cwiseAbs().maxCoeff()))};
  }

 private:
  Eigen::Vector3d center_;
  double half_, unit_, most_ = 0;
};

/// Ball of all points that `each` passes to its argument, a function; empty if there are none.
/// throws  Error if it exceeds the range of numbers
template <class Each>
std::optional<Extent> ball_around(Each&& each) {
  Bounds bounds;
  each([&](const Eigen::Vector3d& p) { bounds.add(p); });
  if (bounds.empty()) return std::nullopt;
  BallAround ball(bounds);
  each([&](const Eigen::Vector3d& p) { ball.add(p); });
  return ball.extent();
}

/// Computes the extents of successive scenes, and caches the bounds of meshes that do not move.
class ExtentFinder {
 public:
  /// Ball around the center of the bounds of all vertices of meshes, cones and arrows, through the
  /// farthest of them. Backgrounds count only if there is nothing else; world [m].
  /// throws  Error if a mesh position or the ball exceeds the range of numbers
  Extent find(const Scene& scene);

 private:
  struct Kept {
    std::shared_ptr<const Shape> shape;
    Pose X_WM;
    Bounds bounds;
  };
  const Bounds& bounds_of(const Scene& scene, size_t i);
  std::optional<Extent> find(const Scene& scene, bool background,
                             const std::vector<Eigen::Vector3d>& marks);

  std::vector<Kept> kept_;  // bounds of the meshes of the last scene
};

}  // namespace clench
