// Geometry from glTF 2.0 files: .gltf with its buffers, and .glb.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// Triangles of all meshes of the file's scene, where its nodes place them; in metres, y up. Skins,
/// morph targets and animations are not used, with a warning.
/// returns  do colours come from the file?
/// throws   Error  "part.glb: accessors[3]: expected 36 bytes of bufferViews[1], got 24"
bool read_gltf(const MeshInput& input, GeometryBuilder& builder);

}  // namespace clench
