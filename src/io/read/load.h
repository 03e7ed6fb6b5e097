// Loads bodies and robots from files of all formats.
#pragma once
#include "clench/io/text/file_cache.h"

namespace clench {

/// The loaders of a FileCache: all formats.
extern const Loaders all_formats;

/// Completes a robot read from a file of any format: adds defaults, stores its origin, and reports
/// implausible, assumed and missing properties.
void finish_robot(RobotSpec& robot, const std::filesystem::path& path, FileCache& cache);

}  // namespace clench
