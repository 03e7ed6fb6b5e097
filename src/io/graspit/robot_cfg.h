// Robots from the text files of GraspIt! up to 2.0.
#pragma once
#include <filesystem>

#include "clench/io/text/file_cache.h"

namespace clench {

/// throws Error  "Barrett.cfg:31: joint 2: min 144 exceeds max 0 [deg]"
RobotSpec read_robot_cfg(const std::filesystem::path& path, FileCache& cache);

}  // namespace clench
