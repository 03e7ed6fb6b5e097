// Geometry from mesh files, which do not contain masses: OBJ, STL, PLY, OFF, glTF and COLLADA.
#pragma once
#include <filesystem>

#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// Triangles in meters, in the unit given by options.mesh_scale, otherwise by the file, otherwise
/// by options.silent_mesh_unit. Otherwise the unit is guessed from the size, with a note.
/// format  none: determined by the ending
/// throws Error  "part.stl: ..." if malformed, empty or truncated
Geometry read_mesh_file(const std::filesystem::path& path, const ReadOptions& options,
                        GeometryFormat format = GeometryFormat::none,
                        BarePoints bare_points = BarePoints::refused);

/// The same for a file that has been read.
Geometry read_mesh(const MeshInput& input);

/// The guessed unit [m] of a mesh whose largest side has that length: meters up to ten units,
/// millimeters beyond.
double guess_mesh_unit(double largest_side);

}  // namespace clench
