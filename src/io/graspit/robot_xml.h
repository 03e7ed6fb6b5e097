// Robots from the XML files of GraspIt! 2.1 and later.
#pragma once
#include "clench/io/text/file_cache.h"

namespace clench {

/// throws Error  "Barrett.xml:70: joint 2: minValue 144 exceeds maxValue 0 [deg]"
RobotSpec read_robot_xml(const std::filesystem::path& path, FileCache& cache);

}  // namespace clench
