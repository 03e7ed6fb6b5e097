// Geometry from PLY files: ascii, and binary of both byte orders.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// Faces and triangle strips over the file's own vertices, in its unit. Elements other than these
/// are stepped over, with a warning; so are properties other than places, colours and indices.
/// returns  do colours come from the file?
/// throws   Error  "part.ply:31: ..." in header and ascii files, "part.ply: face 7 of 12: ..." else
bool read_ply(const MeshInput& input, GeometryBuilder& builder);

}  // namespace clench
