// Writes triangles to mesh files: the counterpart of read_mesh_file.
#pragma once
#include <filesystem>
#include <string_view>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// Writes vertices in meters and triangles in order, as .obj .off .ply (binary) .stl (binary), by
/// the ending. Numbers are read back bit-exactly, except from .stl, which stores 32 bits for each.
/// throws Error if the ending is another one, a number exceeds the range of the format, or the file
/// cannot be written
void write_mesh(const Mesh& mesh, const std::filesystem::path& path);

/// The text of an .off file, in meters.
std::string off_text(const Mesh& mesh);

/// True for endings of mesh files that can be written: ".obj", in lower case.
bool is_mesh_ending(std::string_view ending);

}  // namespace clench
