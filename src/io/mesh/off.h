// Geometry from OFF files of the Geomview kind: OFF, COFF, NOFF, STOFF and what these make
// together.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// Faces over the file's own vertices, in its unit. Texture coordinates and normals are not read.
/// returns  do colours come from the file?
/// throws   Error  "part.off:31: expected 3 vertices from 0 to 8, got '9'"
bool read_off(const MeshInput& input, GeometryBuilder& builder);

}  // namespace clench
