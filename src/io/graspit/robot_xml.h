// Robots from the XML files of GraspIt! 2.1 and later.
#pragma once
#include "clench/io/text/library.h"

namespace clench {

/// throws Error  "Barrett.xml:70: joint 2: minValue 144 exceeds maxValue 0 [deg]"
RobotSpec read_robot_xml(const std::filesystem::path& path, Library& library);

}  // namespace clench
