// The text of a robot's file in each format. Links and all else that stands beside go to the
// folder.
#pragma once
#include "io/robot_folder.h"

namespace clench {

/// `robot` as dh_robot gives it.
std::string robot_cfg_text(const RobotSpec& robot, RobotFolder& folder);
/// `robot` as dh_robot gives it.
/// throws Error when a link does not follow on the one before it by 0 to 3 joints
std::string robot_xml_text(const RobotSpec& robot, RobotFolder& folder);
/// Writes what stands beside, too: virtual contacts are numbered as a reader of the file has them.
std::string robot_urdf_text(const RobotSpec& robot, RobotFolder& folder);

/// Tell what .cfg and .xml, only .cfg, only .xml, and .urdf cannot hold.
void tell_lost_in_both(const RobotSpec& robot, const RobotFolder& folder);
void tell_lost_in_cfg(const RobotSpec& robot, const RobotFolder& folder);
void tell_lost_in_xml(const RobotSpec& robot, const RobotFolder& folder);
void tell_lost_in_urdf(const RobotSpec& robot, const RobotFolder& folder);

/// The robot's class as the formats of GraspIt! have it: one word; Hand where it is none of theirs.
std::string class_word(const RobotSpec& robot);

}  // namespace clench
