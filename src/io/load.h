// Bodies and robots from their files, by what these hold.
#pragma once
#include "clench/io/text/file_cache.h"

namespace clench {

/// What a FileCache reads files with: all formats.
extern const Loaders all_formats;

/// What every robot is given, and told of, that was read from a file, wherever it stands.
void finish_robot(RobotSpec& robot, const std::filesystem::path& path, FileCache& cache);

}  // namespace clench
