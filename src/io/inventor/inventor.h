// Geometry from Inventor and VRML files, ascii, all versions up to VRML 97.
#pragma once
#include <filesystem>

#include "clench/io/mesh/geometry_builder.h"

namespace clench {

/// Triangles of the file and of those it includes; coordinates count as millimeters, unless
/// options.mesh_scale says otherwise. Lines, points
/// and text have none. `text` is what the file holds, its lines ended by '\n'. A file of frames
/// only gives an empty mesh.
/// throws Error  "box.iv:31: ..." when the file or one that it includes is malformed, missing or
/// includes itself
Geometry read_inventor(const std::filesystem::path& path, const std::string& text,
                       const ReadOptions& options);

}  // namespace clench
