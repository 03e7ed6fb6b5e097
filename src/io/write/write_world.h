// Writes worlds to files: the counterpart of read_world.
#pragma once
#include "clench/io/text/write_options.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// The ending selects the format: .wld and .xml of GraspIt!, or .lua, a script that builds the
/// world. Numbers are read back bit-exactly if the format's unit allows it. Bodies without a file,
/// and bodies whose file holds another surface, are written into a folder next to the world, named
/// by a hash of its contents: w_files/1a2b3c4d/ball.xml and ball.off; .lua contains their
/// triangles. Robots are referred to by their files.
/// throws Error if a robot has no file, or a file cannot be written; an older file is kept then
void write_world(const WorldSpec& world, const std::filesystem::path& path,
                 const WriteOptions& options = {});

}  // namespace clench
