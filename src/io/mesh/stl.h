// Geometry from STL files, ascii and binary.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// The facets, in the file's unit. Normals are not read: the order of the corners says what is
/// outside.
/// throws  Error  "part.stl:31: expected 'vertex', got 'vertx'"  "part.stl: facet 12 of 99: ..."
void read_stl(const MeshInput& input, GeometryBuilder& builder);

}  // namespace clench
