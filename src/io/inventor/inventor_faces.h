// Faces of Inventor and VRML shapes: of shapes that list their points, and of shapes defined by
// their sizes.
#pragma once
#include "clench/io/inventor/inventor_walk.h"

namespace clench {

/// Receives the faces of one shape one by one.
struct InventorSurface {
  bool convex = false;                       ///< the file declares all faces convex
  bool clockwise = false;                    ///< corners run clockwise seen from outside
  std::vector<Eigen::Vector3f> colors = {};  ///< empty: the colors of the current material
  /// Called with the corners of a face and the number of its color.
  std::function<void(std::span<const InventorVector>, int)> add = {};
};

/// Passes on the faces of a shape that lists its points.   returns  false for other shapes
/// throws Error  "IndexedFaceSet: number 7 of coordIndex: expected -1 or one of 8 points, got 12"
bool list_faces(const InventorNode& shape, const InventorState& state, InventorSurface& surface);

/// Passes on the triangles of a cube, sphere, cylinder, cone or extrusion.   returns  false for
/// other shapes
/// throws Error  "Extrusion: expected at most ... triangles"
bool cut_shape(const InventorNode& shape, const InventorState& state, InventorSurface& surface);

}  // namespace clench
