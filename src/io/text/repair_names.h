// Replaces characters that names must not contain, and reports each change.
#pragma once
#include "clench/io/text/find_file.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// Messages begin with `place`, "hand.urdf".
void repair_names(BodySpec& body, const Place& place, const ReadOptions& options);

/// Repairs the names of a robot and of all its parts, then checks it.
/// throws  Error "hand.urdf: arm: chain 0 joint 1: ..." if check_robot does
void check_read_robot(RobotSpec& robot, const Place& place, const ReadOptions& options);

}  // namespace clench
