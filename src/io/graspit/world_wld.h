// Worlds from the text files of GraspIt! up to 2.0.
#pragma once
#include <filesystem>

#include "clench/io/text/file_cache.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// throws Error  "mug.wld:12: ..." where a line is not as expected, or a file that it names cannot
///               be
/// read
WorldSpec read_world_wld(const std::filesystem::path& path, FileCache& cache);

}  // namespace clench
