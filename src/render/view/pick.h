// What is under a pixel of a picture, found on the scene itself: needs no graphics.
#pragma once
#include <optional>

#include "clench/scene/scene.h"

namespace clench {

/// The first surface that is seen there.
struct Picked {
  Shown shown;                                    ///< of its entry, Shown::Kind::floor of the floor
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  ///< unit, to the side of the eye
  double distance = 0;  ///< from the eye, along the view where that is orthographic [m]
};

/// Place in a picture, from its upper left corner, and the size of the picture [pixels]. The middle
/// of the first pixel is at 0.5, 0.5.
struct PicturePlace {
  double x = 0, y = 0;
  double width = 1, height = 1;
};

/// Casts a ray at meshes, also those that one sees through, and at cones, arrows and the floor;
/// none where it meets nothing. A floor is met from above alone, as it is drawn.
/// throws  Error as `view_axes` and `check(scene)` do, and on a size that is not > 0
std::optional<Picked> pick(const Scene& scene, const Eye& eye, const PicturePlace& place);

}  // namespace clench
