// Robots to files: the other side of read_robot.
#pragma once
#include "clench/io/write_world.h"

namespace clench {

/// As .urdf. What stands beside, in folders made where they are missing: links as
/// HAND_files/LINK.obj; eigen/HAND_urdf.egr (.xml where amplitudes have limits),
/// virtual/HAND_urdf.vgr, glove/HAND_urdf.txt. What the format cannot say stands in an element
/// <clench>, which names these files. Read again, a robot has the same DOFs in the same ranges,
/// closes as before, and every surface stands in the same place for all their values. Links' frames
/// stand on the axes: where ours is not on its axis, surfaces, inertias and contacts stand in that
/// one. options.diagnostics is told, a sentence each, of all that the format cannot hold. throws Error,
/// having written nothing, when the ending is another one or a number is out of order; and when a
/// file cannot be written: an older one of the robot stays then
void write_robot(const RobotSpec& robot, const std::filesystem::path& path,
                 const WriteOptions& options = {});

}  // namespace clench
