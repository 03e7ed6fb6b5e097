// Which meshes show only one side, so that the other need not be drawn.
#pragma once
#include "clench/geometry/tree/shape.h"
#include "clench/scene/scene.h"

namespace clench {

/// Is each part of the mesh closed, with its triangles counter-clockwise seen from outside? A
/// hollow has its own part, which is not.
bool faces_outward(const Shape& shape);

/// Can an eye see only the sides that face outward of such a mesh within a ball, in scene units?
/// Not from within it, or with the near plane in it, which lies at less than half the way to the
/// scene.
bool hides_inside(const Eigen::Vector3d& center, double radius, const Eye& eye);

}  // namespace clench
