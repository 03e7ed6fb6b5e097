// Bounding volumes of a shape, for display.
#pragma once
#include <vector>

#include "clench/geometry/tree/shape.h"

namespace clench {

struct OrientedBox {
  Pose X_MB;             ///< its center and axes in the frame of the mesh
  Eigen::Vector3d half;  ///< half extents along its axes [m]
};

inline constexpr int max_box_depth = 6;

/// The boxes of the tree of a shape at a depth: one at depth 0, up to eight times as many at each
/// further depth. Branches that end earlier are represented by their last boxes.
/// depth   0..max_box_depth
/// throws  Error if it is out of range; Stopped
std::vector<OrientedBox> bounding_boxes(const Shape& shape, int depth,
                                        const Progress& progress = {});

}  // namespace clench
