// The boundary of a solid that is a union of parts. For the queries of this module only.
#pragma once
#include <memory>
#include <vector>

#include "clench/geometry/tree/shape.h"

namespace clench {

/// The faces of a closed shape that separate its inside from its outside.
struct ExposedSurface {
  ShapePtr shape;              ///< null: all faces do, and the shape itself serves
  std::vector<int> triangles;  ///< of the shape given, that those of `shape` are parts of
};

/// Cuts off what lies within other parts of the shape, and faces on which two parts adjoin. A part
/// that intersects itself keeps its faces. The shape keeps the result: any thread may ask.
/// returns  never null
/// throws   Stopped
std::shared_ptr<const ExposedSurface> exposed_surface(const Shape& shape,
                                                      const Progress& progress = {});

}  // namespace clench
