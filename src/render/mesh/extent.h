// Where a scene is and how large: its unit of length.
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

  /// An eye of the world, moved to the center and divided by the scale.
  Eye to_scene(const Eye& world) const;
};

/// A ball about the center of bounds, through the point of them that is farthest. Squares of lengths
/// do not overflow.
class BallAround {
 public:
  explicit BallAround(const Bounds& bounds)
      : center_(0.5 * bounds.low + 0.5 * bounds.high),
        half_((0.5 * bounds.high - 0.5 * bounds.low).maxCoeff()),
        unit_(1 / half_) {}
  const Eigen::Vector3d& center() const { return center_; }
  /// of the bounds, as which distances are measured; infinite where they have no size
  double unit() const { return unit_; }
  void add(const Eigen::Vector3d& p) {
    if (std::isfinite(unit_)) most_ = std::max(most_, (unit_ * (p - center_)).squaredNorm());
  }
  /// Square of the distance of the farthest point so far, in such units.
  double farthest() const { return most_; }
  /// throws  Error when it is larger than numbers can be
  Extent extent() const {
    const double scale = half_ * std::sqrt(most_);
    if (!std::isfinite(scale)) fail("picture: the scene is larger than numbers can be");
    // a single point is seen from a distance that its coordinates can resolve
    return {center_, std::max(scale, 1e-9 * std::max(1.0, center_.cwiseAbs().maxCoeff()))};
  }

 private:
  Eigen::Vector3d center_;
  double half_, unit_, most_ = 0;
};

/// Of all points that `each` gives to a function it is given; none where there is no point.
/// throws  Error when it is larger than numbers can be
template <class Each>
std::optional<Extent> ball_around(Each&& each) {
  Bounds bounds;
  each([&](const Eigen::Vector3d& p) { bounds.add(p); });
  if (bounds.empty()) return std::nullopt;
  BallAround ball(bounds);
  each([&](const Eigen::Vector3d& p) { ball.add(p); });
  return ball.extent();
}

/// Finds the extent of scene after scene; bounds of meshes that stay where they were are kept.
class ExtentFinder {
 public:
  /// A ball about the center of the bounds of every vertex of meshes, cones and arrows, through the
  /// farthest of them. Backgrounds do not count unless there is nothing else; world [m].
  /// throws  Error when a mesh is moved beyond all numbers, or the ball is larger than numbers can be
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

  std::vector<Kept> kept_;  // of the meshes of the last scene
};

}  // namespace clench
