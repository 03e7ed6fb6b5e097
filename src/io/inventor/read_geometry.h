// Reads files of any format that contain only triangles.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/text/file_kind.h"

namespace clench {

/// Triangles of a file that contains nothing else. format  none: determined by the ending. `text`
/// holds the contents of an Inventor or VRML file, which is read if it is null.
/// throws Error if the ending is not that of a geometry file, and no format is given
Geometry read_geometry(const std::filesystem::path& path, const ReadOptions& options,
                       GeometryFormat format = GeometryFormat::none,
                       const std::string* text = nullptr);

}  // namespace clench
