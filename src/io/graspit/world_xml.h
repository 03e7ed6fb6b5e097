// Worlds from the XML files of GraspIt! 2.1 and later.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// throws Error  "mug.xml:12: ..." where an element is not as expected, or a file that it names
///               cannot
/// be read
WorldSpec read_world_xml(const std::filesystem::path& path, FileCache& cache);

}  // namespace clench
