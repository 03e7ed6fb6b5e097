// Writes bodies to files: the counterpart of read_body.
#pragma once
#include "clench/io/write/write_world.h"

namespace clench {

/// The ending selects the format: .xml of GraspIt!, whose surface is written as
/// NAME_files/1a2b3c4d/BODY.off; .iv with its '#' lines; or only the triangles as .obj .off .ply
/// .stl, in meters. options.diagnostics receives the properties that the format cannot hold.
/// throws Error if the ending is another one, a mesh format is requested for a body without a
/// surface, or the file cannot be written
void write_body(const BodySpec& body, const std::filesystem::path& path,
                const WriteOptions& options = {});

}  // namespace clench
