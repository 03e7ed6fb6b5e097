// Faces of Inventor and VRML shapes: of those that list their points, and of those that are given by
// their sizes.
#pragma once
#include "clench/io/inventor/inventor_walk.h"

namespace clench {

/// Takes the faces of one shape, one after the other.
struct InventorSurface {
  bool convex = false;                       ///< the file says that all are
  bool clockwise = false;                    ///< corners run clockwise seen from outside
  std::vector<Eigen::Vector3f> colors = {};  ///< empty: the colors of the material in force
  /// Corners of a face, and the number of its color.
  std::function<void(std::span<const InventorVector>, int)> add = {};
};

/// Gives the faces of a shape that lists its points.   returns  is it such a shape?
/// throws Error  "IndexedFaceSet: number 7 of coordIndex: expected -1 or one of 8 points, got 12"
bool list_faces(const InventorNode& shape, const InventorState& state, InventorSurface& surface);

/// Gives the triangles of a cube, sphere, cylinder, cone or extrusion.   returns  is it one?
/// throws Error  "Extrusion: expected at most ... triangles"
bool cut_shape(const InventorNode& shape, const InventorState& state, InventorSurface& surface);

}  // namespace clench
