// Robots from MJCF, the format of MuJoCo.
#pragma once
#include <filesystem>

#include "clench/io/text/library.h"

namespace clench {

/// throws Error  "hand.xml:31: joint: range: expected 2 numbers, got 3"
RobotSpec read_robot_mjcf(const std::filesystem::path& path, Library& library);

}  // namespace clench
