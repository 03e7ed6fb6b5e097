// Efforts that the motors of a robot can exert in its present posture: used by force programs,
// verification and simulation alike.
#pragma once
#include "clench/model/world.h"
#include "clench/spec/dof_drive.h"

namespace clench {

/// Efforts on the DOF at rest in its present position, over all controls of its actuators; infinite
/// without a given limit, {0, 0} for a DOF that is not driven [N m or N]. RobotDynamics::max_effort
/// replaces limits that are not given.
EffortRange effort_range(const World& world, Id<Robot> robot, int dof);

/// Efforts that its motor can exert at any position and velocity, see DofDrive::limits. For a DOF
/// that is not driven: those of the motor that a script adds [N m or N].
EffortRange effort_limits(const World& world, Id<Robot> robot, int dof);

/// Can its motor push the DOF in the direction of its default velocity, at either end of its range?
/// false without such a velocity.
bool can_close(const World& world, Id<Robot> robot, int dof);

/// DOFs whose motors have no limit in some direction.
std::vector<int> unlimited_dofs(const World& world, Id<Robot> robot);

}  // namespace clench
