// Geometry from mesh files without units or masses: OBJ and STL; read through assimp.
#pragma once
#include <filesystem>

#include "io/geometry_builder.h"

namespace clench {

/// Triangles; coordinates count as metres times `options.mesh_scale`.
/// throws Error  "part.stl: ..." when malformed, empty or cut short
Geometry read_mesh_file(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace clench
