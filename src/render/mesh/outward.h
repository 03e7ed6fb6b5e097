// Meshes of which only the outer side can ever be visible, so that the inner side need not be
// drawn.
#pragma once
#include "clench/geometry/tree/shape.h"
#include "clench/scene/scene.h"

namespace clench {

/// Is each part of the mesh closed, with its triangles counter-clockwise seen from outside? A
/// cavity is a part of the opposite orientation, and fails the test.
bool faces_outward(const Shape& shape);

/// Does an eye see only outward-facing sides of such a mesh within a ball, in scene units? Not from
/// within the ball, or if the near plane, at less than half the distance to the scene, cuts it.
bool hides_inside(const Eigen::Vector3d& center, double radius, const Eye& eye);

}  // namespace clench
