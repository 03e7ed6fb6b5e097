// Worlds to files: the other side of read_world.
#pragma once
#include "clench/io/text/write_options.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// By the ending: .wld and .xml as GraspIt! has them, .lua a script that makes the world. Numbers
/// are written so that reading gives them back to the bit where the format's unit allows it. Bodies
/// without a file, and those whose file holds another surface, are written into a folder beside,
/// called after what they hold: w_files/1a2b3c4d/ball.xml and ball.off; a .lua holds their
/// triangles itself. Robots are named by their files.
/// throws Error when a robot has no file, or a file cannot be written; an older file stays then
void write_world(const WorldSpec& world, const std::filesystem::path& path,
                 const WriteOptions& options = {});

}  // namespace clench
