// Files that hold triangles and nothing else, of any format.
#pragma once
#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/text/file_kind.h"

namespace clench {

/// Triangles of a file that holds nothing else, in a format, none: the one of its ending. `text` is
/// what an Inventor or VRML file holds, read when it is null.
/// throws Error when the ending is none of a geometry file, and no format is given
Geometry read_geometry(const std::filesystem::path& path, const ReadOptions& options,
                       GeometryFormat format = GeometryFormat::none,
                       const std::string* text = nullptr);

}  // namespace clench
