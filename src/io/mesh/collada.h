// Geometry from COLLADA files (.dae), versions 1.4 and 1.5.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// Polygons of all geometries of the file's scene, where its nodes place them; in the file's unit,
/// with its upward axis. Skins and morphs are not used, with a warning.
/// returns  do colours come from the file?
/// throws   Error  "part.dae:31: ..."
bool read_collada(const MeshInput& input, GeometryBuilder& builder);

}  // namespace clench
