// Picking: finds the surface under a pixel of a picture on the scene itself, without graphics.
#pragma once
#include <optional>

#include "clench/scene/scene.h"

namespace clench {

/// The first visible surface.
struct Picked {
  Shown shown;  ///< index of its entry; Shown::Kind::floor for the floor
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  ///< unit, on the side of the eye
  double distance = 0;  ///< distance from the eye, along the view if that is orthographic [m]
};

/// Position in a picture, from its upper left corner, and the size of the picture [pixels]. The
/// center of the first pixel is at 0.5, 0.5.
struct PicturePlace {
  double x = 0, y = 0;
  double width = 1, height = 1;
};

/// Casts a ray at meshes, including transparent ones, and at cones, arrows and the floor; empty if
/// it hits nothing. The floor is hit only from above, as it is drawn.
/// throws  Error as `view_axes` and `check(scene)` do, and if a size is not > 0
std::optional<Picked> pick(const Scene& scene, const Eye& eye, const PicturePlace& place);

}  // namespace clench
