// Reads robots and worlds from MJCF, the format of MuJoCo.
#pragma once
#include <filesystem>

#include "clench/io/text/file_cache.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// throws Error  "hand.xml:31: joint: range: expected 2 numbers, got 3"
RobotSpec read_robot_mjcf(const std::filesystem::path& path, FileCache& cache);
/// One of the robots that read_world_mjcf finds: the one whose joint tree begins with the body of
/// that name.
/// throws Error  that lists the names if there is none
RobotSpec read_robot_mjcf(const std::filesystem::path& path, const std::string& body,
                          FileCache& cache);
/// A scene: each joint tree becomes a robot, free bodies become objects, fixed bodies obstacles.
WorldSpec read_world_mjcf(const std::filesystem::path& path, FileCache& cache);

}  // namespace clench
