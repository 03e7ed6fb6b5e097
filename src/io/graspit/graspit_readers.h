// Readers of GraspIt!'s robots and worlds: text files up to 2.0, XML files from 2.1 on. Files that
// they name are read through the cache.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// throws Error  "Barrett.cfg:31: joint 2: min 144 exceeds max 0 [deg]"
RobotSpec read_robot_cfg(const std::filesystem::path& path, FileCache& cache);
/// throws Error  "Barrett.xml:70: joint 2: minValue 144 exceeds maxValue 0 [deg]"
RobotSpec read_robot_xml(const std::filesystem::path& path, FileCache& cache);

/// throws Error  "mug.wld:12: ..." for an invalid line, or if a file that it names cannot be read
WorldSpec read_world_wld(const std::filesystem::path& path, FileCache& cache);
/// throws Error  "mug.xml:12: ..." likewise, for an element
WorldSpec read_world_xml(const std::filesystem::path& path, FileCache& cache);

}  // namespace clench
