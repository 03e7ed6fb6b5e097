// Triangles to mesh files: the other side of read_mesh_file.
#pragma once
#include <filesystem>
#include <string_view>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// Vertices in meters, triangles in their order, as .obj .off .ply (binary) .stl (binary), by the
/// ending. Numbers come back to the bit, but from .stl, which holds 32 bits of each.
/// throws Error when the ending is another one, a number is beyond the format's, or the file cannot
/// be written
void write_mesh(const Mesh& mesh, const std::filesystem::path& path);

/// The text of an .off, meters.
std::string off_text(const Mesh& mesh);

/// Is it the ending of a mesh file that can be written? ".obj", in lower case
bool is_mesh_ending(std::string_view ending);

}  // namespace clench
