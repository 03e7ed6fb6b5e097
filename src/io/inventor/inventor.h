// Geometry from Inventor and VRML files, ascii, all versions up to VRML 97.
#pragma once
#include <filesystem>

#include "clench/io/mesh/geometry_builder.h"

namespace clench {

/// Triangles of the file and of the files that it includes; coordinates are in millimeters, unless
/// options.mesh_scale is set. Lines, points and text contain no triangles. `text` holds the
/// contents of the file, with lines ended by '\n'. A file that contains only frames gives an empty
/// mesh.
/// throws Error  "box.iv:31: ..." if the file or an included one is malformed, missing or includes
/// itself
Geometry read_inventor(const std::filesystem::path& path, const std::string& text,
                       const ReadOptions& options);

}  // namespace clench
