// Closing directions of DOFs and approach frames chosen by options, which replace those of the
// file.
#pragma once
#include "clench/io/text/find_file.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// Sets the velocity with which a DOF closes: `sense` > 0 up, < 0 down, 0 not at all. The speed is
/// kept if it is not 0; otherwise it is 1 rad/s or 5 cm/s.
void set_closing(RobotSpec& robot, int dof, double sense);

/// Halves the closing speed of DOFs whose joints are all distal to another closing joint of the
/// same finger: the finger then moves to the object from its root and wraps around it, instead of
/// curling up before it gets there.
void slow_distal_joints(RobotSpec& robot);

/// Applies options.closing and options.approach. `file` is the name shown in errors.
/// throws  Error  "hand.urdf: close: expected the name of a DOF or a number from 1 to 16, got 'x'"
void choose_closing(RobotSpec& robot, const std::string& file, const ReadOptions& options);

}  // namespace clench
