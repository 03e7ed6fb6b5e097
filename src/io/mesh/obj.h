// Geometry from Wavefront OBJ files, and colours from their MTL files.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// Faces over the file's own points, in its unit. Texture coordinates and normals are not read.
/// returns  do colours come from the file?
/// throws   Error  "part.obj:31: expected one of 8 points after f, got 9"
bool read_obj(const MeshInput& input, GeometryBuilder& builder);

}  // namespace clench
