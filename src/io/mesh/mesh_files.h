// Geometry from mesh files, which say nothing of masses: OBJ, STL, PLY, OFF, glTF and COLLADA.
#pragma once
#include <filesystem>

#include "clench/io/mesh/geometry_builder.h"
#include "clench/io/mesh/mesh_input.h"

namespace clench {

/// Triangles in meters, by options.mesh_scale, else by the unit that the file names, else by
/// options.silent_mesh_unit, else by a guess from the size, which is noted.
/// format  none: the one of the ending
/// throws Error  "part.stl: ..." when malformed, empty or cut short
Geometry read_mesh_file(const std::filesystem::path& path, const ReadOptions& options,
                        GeometryFormat format = GeometryFormat::none,
                        BarePoints bare_points = BarePoints::refused);

/// The same of a file that has been read.
Geometry read_mesh(const MeshInput& input);

/// The unit [m] of a mesh whose largest side has that length, if nobody says: meters up to ten
/// units, millimeters beyond.
double guess_mesh_unit(double largest_side);

}  // namespace clench
