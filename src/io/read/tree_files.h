// URDF and MJCF files, which describe a robot as a tree of links; recognized by ending or contents.
#pragma once
#include <filesystem>

#include "clench/io/text/file_cache.h"

namespace clench {

/// True for .urdf .mjcf .xacro, and for .xml files that contain one of them.
bool is_robot_tree(const std::filesystem::path& path);

/// throws Error with the line, or an Error that asks to expand xacro first
/// body  scenes: name of the robot's root body; empty: the only robot of the file
RobotSpec read_robot_tree(const std::filesystem::path& path, const std::string& body,
                          FileCache& cache);

/// True for MJCF.
bool is_scene(const std::filesystem::path& path);

}  // namespace clench
