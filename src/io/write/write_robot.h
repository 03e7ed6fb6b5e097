// Writes robots to files: the counterpart of read_robot.
#pragma once
#include "clench/io/write/write_world.h"

namespace clench {

/// Writes .urdf and, in folders that are created as needed: links as HAND_files/LINK.obj;
/// eigen/HAND_urdf.egr (.xml if amplitudes have limits), virtual/HAND_urdf.vgr,
/// glove/HAND_urdf.txt. Properties that URDF has no elements for are in an element <clench>, which
/// names these files. When read again, the robot has the same DOFs with the same ranges and closing
/// directions, and for all DOF values every surface has the same pose. Frames of links are on the
/// axes of their joints: if the robot's frame is not on its axis, surfaces, inertias and contacts
/// are expressed in a frame that is. options.diagnostics receives one message for each property
/// that the format cannot hold.
/// throws Error, and writes nothing, if the ending is another one or a number is invalid; also if a
/// file cannot be written: an older file of the robot is kept then
void write_robot(const RobotSpec& robot, const std::filesystem::path& path,
                 const WriteOptions& options = {});

}  // namespace clench
