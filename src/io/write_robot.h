// Robots to files: the other side of read_robot.
#pragma once
#include "io/write_world.h"

namespace clench {

/// By the ending: .cfg and .xml as GraspIt! has them, .urdf. What stands beside, in folders made
/// where they are missing: links as iv/HAND_cfg/LINK.xml and .off (.cfg, .xml) or HAND_files/LINK.obj
/// (.urdf); eigen/HAND_cfg.egr (.xml where amplitudes have limits), virtual/HAND_cfg.vgr, glove/HAND_cfg.txt,
/// which a .urdf cannot name. Read again, a robot has the same DOFs in the same ranges, and every
/// surface stands in the same place for all their values; what its own format holds comes back to
/// the bit where the format's unit allows it; a surface with doubled triangles is mended. A robot
/// is called as its file, but by a .urdf.
///
/// .cfg and .xml hold chains that begin on the base (or on a link that cannot move), of joints
/// after Denavit and Hartenberg; joints placed freely become those, and links get other frames
/// where they must: dh_robot. A .urdf has its links' frames on the axes: where ours is not on its
/// axis, surfaces, inertias and contacts stand in that one.
/// options.warn is told, a sentence each, of all that the format cannot hold.
/// throws Error, having written nothing, when the ending is another one, a number is out of order,
/// or the format cannot hold the robot's chains; and when a file cannot be written: an older one of
/// the robot stays then
void write_robot(const RobotSpec& robot, const std::filesystem::path& path,
                 const WriteOptions& options = {});

}  // namespace clench
