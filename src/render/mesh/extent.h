// Where a scene is and how large: its unit of length.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "clench/base/error.h"
#include "clench/scene/scene.h"

namespace clench {

/// A ball [m].
struct Extent {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double scale = 1;

  /// An eye of the world, moved to the centre and divided by the scale.
  Eye to_scene(const Eye& world) const;
};

/// About the centre of the bounds of all points that `each` gives to a function it is given, and
/// through the farthest; none where there is no point. Squares do not overflow.
/// throws  Error when it is larger than numbers can be
template <class Each>
std::optional<Extent> ball_around(Each&& each) {
  Bounds bounds;
  each([&](const Eigen::Vector3d& p) { bounds.add(p); });
  if (bounds.empty()) return std::nullopt;
  const Eigen::Vector3d centre = 0.5 * bounds.low + 0.5 * bounds.high;
  const double half = (0.5 * bounds.high - 0.5 * bounds.low).maxCoeff();
  double most = 0;
  if (const double unit = 1 / half; std::isfinite(unit))
    each([&](const Eigen::Vector3d& p) {
      most = std::max(most, (unit * (p - centre)).squaredNorm());
    });
  const double scale = half * std::sqrt(most);
  if (!std::isfinite(scale)) fail("picture: the scene is larger than numbers can be");
  // a single point is seen from a distance that its coordinates can resolve
  return Extent{centre, std::max(scale, 1e-9 * std::max(1.0, centre.cwiseAbs().maxCoeff()))};
}

/// It holds every vertex of meshes, cones and arrows, but not of backgrounds unless there is
/// nothing else; world [m].
/// throws  Error when a mesh is moved beyond all numbers, too
Extent extent_of(const Scene& scene);

}  // namespace clench
