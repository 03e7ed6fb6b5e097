// How a hand closes and approaches where the options of the call say so, whatever its file says.
#pragma once
#include "clench/io/text/find_file.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// Sets the pace at which a DOF closes: `sense` > 0 up, < 0 down, 0 not at all; as fast as it was
/// meant to, else 1 rad/s or 5 cm/s.
void set_closing(RobotSpec& robot, int dof, double sense);

/// DOFs whose joints all stand behind another one that closes, in the same finger, close half as
/// fast as they did: so a finger goes to the object from its root and wraps around it, where it
/// would else curl up before it gets there.
void slow_distal_joints(RobotSpec& robot);

/// Follows options.closing and options.approach. `file` is the name shown in errors.
/// throws  Error  "hand.urdf: close: expected the name of a DOF or a number from 1 to 16, got 'x'"
void choose_closing(RobotSpec& robot, const std::string& file, const ReadOptions& options);

}  // namespace clench
