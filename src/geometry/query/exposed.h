// Boundary of a solid that is a union of parts. For the queries of this module only.
#pragma once
#include <memory>
#include <vector>

#include "clench/geometry/tree/shape.h"

namespace clench {

/// The faces of a closed shape that separate its inside from its outside.
struct ExposedSurface {
  ShapePtr shape;              ///< null: all faces do, and the shape itself is used
  std::vector<int> triangles;  ///< triangles of the given shape that contain those of `shape`
};

/// Removes what lies within other parts of the shape, and faces shared by two parts. A part that
/// intersects itself keeps its faces. The shape caches the result: any thread may call this.
/// returns  never null
/// throws   Stopped
std::shared_ptr<const ExposedSurface> exposed_surface(const Shape& shape,
                                                      const Progress& progress = {});

}  // namespace clench
