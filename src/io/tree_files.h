// Files of today that describe a robot as a tree: URDF and MJCF, by ending or by what they hold.
#pragma once
#include <filesystem>

#include "clench/io/text/file_cache.h"

namespace clench {

/// Is it one of .urdf .mjcf .xacro, or an .xml file that holds one of them?
bool is_robot_tree(const std::filesystem::path& path);

/// throws Error naming the line, or saying that xacro must be expanded first
/// body  of a scene: the body that the robot begins with; empty: the file's robot
RobotSpec read_robot_tree(const std::filesystem::path& path, const std::string& body,
                          FileCache& cache);

/// Is it MJCF?
bool is_scene(const std::filesystem::path& path);

}  // namespace clench
