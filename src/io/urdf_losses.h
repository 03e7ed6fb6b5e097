// What a URDF cannot hold of a robot.
#pragma once
#include "clench/io/robot_folder.h"

namespace clench {

/// Tells of it, a sentence each.
void report_losses(const RobotSpec& robot, const RobotFolder& folder);

}  // namespace clench
