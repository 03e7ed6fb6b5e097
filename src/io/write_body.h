// Bodies to files: the other side of read_body.
#pragma once
#include "clench/io/write_world.h"

namespace clench {

/// By the ending: .xml as GraspIt! has it, its surface beside as NAME_files/1a2b3c4d/BODY.off; .iv
/// with its '#' lines; or the bare triangles as .obj .off .ply .stl, in meters. options.diagnostics is
/// told what the format cannot hold.
/// throws Error when the ending is another one, a bare mesh is expected of a body without a
/// surface, or the file cannot be written
void write_body(const BodySpec& body, const std::filesystem::path& path,
                const WriteOptions& options = {});

}  // namespace clench
