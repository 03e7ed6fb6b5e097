// Robots from URDF, the format of ROS.
#pragma once
#include <filesystem>

#include "clench/io/text/file_cache.h"

namespace clench {

/// throws Error  "hand.urdf:31: joint 'a': lower 2 exceeds upper 1 [rad]"
RobotSpec read_robot_urdf(const std::filesystem::path& path, FileCache& cache);

/// True if this text is a URDF: its root element is a <robot> that contains links.
bool looks_like_urdf(std::string_view text);

}  // namespace clench
