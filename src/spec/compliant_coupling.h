// Joints that one tendon pulls against their springs: motion of each in free air.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

/// Computes the ratios of the joints of compliant DOFs from the numbers in files. There a joint's
/// number t is the tendon's torque on the link beyond it, relative to the DOF's other joints. In
/// free air springs of stiffness k balance it: the torque on joint j is T_j = sum of t_i (axis_i .
/// axis_j) over the DOF's joints from j outwards, and it turns by T_j / k_j. So its ratio is t_1
/// (k_1 / k_j) (T_j / T_1), with 1 the DOF's first joint, and a stiff joint closes less. A DOF
/// keeps the file's ratios if one of its joints has no spring or no torque in its direction, or if
/// some of them turn and others slide.
/// source  Dollar & Howe (2010), The highly adaptive SDM hand: joints where a tendon and springs
///         are in balance
void couple_by_springs(RobotSpec& robot);

}  // namespace clench
