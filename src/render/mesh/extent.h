// Where a scene is and how large: its unit of length.
#pragma once
#include "clench/scene/scene.h"

namespace clench {

/// A ball about the centre of the bounds that holds every vertex of meshes, cones and arrows, but not backgrounds unless
/// there is nothing else; world [m].
struct Extent {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double scale = 1;
};

/// throws  Error when a mesh is moved beyond all numbers, or the scene is larger than numbers can be
Extent extent_of(const Scene& scene);

}  // namespace clench
