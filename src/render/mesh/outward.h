// Which meshes show only one side, so that the other need not be drawn.
#pragma once
#include "clench/geometry/tree/shape.h"

namespace clench {

/// Is each part of the mesh closed, with its triangles counter-clockwise seen from outside? A hollow has its own part,
/// which is not.
bool faces_outward(const Shape& shape);

}  // namespace clench
