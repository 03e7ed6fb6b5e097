// Degrees of freedom in messages, and their limits.
#pragma once
#include "clench/base/diagnostic.h"
#include "clench/model/robot.h"

namespace clench {

/// Name in its file, or "dof3".
/// dof  from 0
std::string dof_name(const Robot& robot, int dof);
/// Names of all joints, as returned by joint_names_of.
std::vector<std::string> joint_names(const Robot& robot);
/// Does its first joint slide? Then its unit is the meter, otherwise the radian.
bool dof_slides(const Robot& robot, int dof);

/// The limits of a DOF. Those of an endless one are not stops: they are shifted so that `value` is
/// in their middle, and bound closing and searches from there.
std::array<double, 2> range_around(const Robot& robot, int dof, double value);

/// The value; the limit if the value exceeds it by no more than the rounding of a number of 32
/// bits; any finite value of an endless DOF.
/// subject  "robot": beginning of the sentence, before the robot's name
/// throws  Error "robot 'dlr': DOF 3 'thumb_1' must lie in [0, 1.571] rad, got 90; degrees?
///         clench.rad(90) is 1.571"
double within_limits(const Robot& robot, int dof, double value, std::string_view subject);

/// Largest excess over a limit that is clamped with a warning: simulators satisfy limits to about
/// 1e-3.
constexpr double soft_excess_angle = 0.02;     ///< [rad]
constexpr double soft_excess_distance = 1e-3;  ///< [m]

/// As within_limits, for values of other programs: a value that exceeds a limit by at most
/// soft_excess_angle or soft_excess_distance is set to the limit as well, which is warned of:
/// "robot 'dlr': DOF 3 'thumb_1': 1.5702 exceeds the limit 1.57 rad; the limit is used"
/// throws  Error as within_limits for values farther beyond
double near_limits(const Robot& robot, int dof, double value, const Place& place,
                   const Diagnostics& diagnostics);

/// The same rule for a joint's position. A position that exceeds a limit by rounding is kept.
double joint_near_limits(const Robot& robot, int joint, double position, const Place& place,
                         const Diagnostics& diagnostics);

/// subject  "autograsp": beginning of the sentence
/// throws  Error "autograsp of 'dlr': expected DOFs from 1 to 12, got 13" for a number, from 0,
///         that is not a DOF's
void check_dof_numbers(const Robot& robot, std::span<const int> dofs, std::string_view subject);

}  // namespace clench
