// A degree of freedom in sentences, and held against its limits.
#pragma once
#include "clench/model/robot.h"

namespace clench {

/// As its file calls it; "dof3" where it does not.   dof  from 0
std::string dof_name(const Robot& robot, int dof);
/// Does its first joint slide? Then it counts in metres, else in radians.
bool dof_slides(const Robot& robot, int dof);

/// The limits of a DOF. Those of an endless one stop nothing: they are moved so that `value` lies
/// in their middle, and say how far it closes, or is searched, from there.
std::array<double, 2> range_around(const Robot& robot, int dof, double value);

/// The value, or the limit that rounding has taken it beyond; any finite value of an endless DOF.
/// subject  "robot": what the sentence begins with, before the robot's name
/// throws  Error "robot 'dlr': DOF 3 'thumb_1' must lie in [0, 1.571] rad, got 90; degrees?
///         clench.rad(90) is 1.571"
double within_limits(const Robot& robot, int dof, double value, std::string_view subject);

/// subject  "autograsp": what the sentence begins with
/// throws  Error "autograsp of 'dlr': expected DOFs from 1 to 12, got 13" for a number, from 0,
///         that no DOF has
void check_dof_numbers(const Robot& robot, std::span<const int> dofs, std::string_view subject);

}  // namespace clench
