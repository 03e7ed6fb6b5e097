// Shapes that Inventor and VRML give by their sizes, cut into triangles.
#pragma once
#include "clench/io/inventor/inventor_faces.h"

namespace clench {

/// Gives the triangles of a cube, sphere, cylinder, cone or extrusion.   returns  is it one?
/// throws Error  "Extrusion: expected at most ... triangles"
bool cut_shape(const InventorNode& shape, const InventorState& state, InventorSurface& surface);

}  // namespace clench
