// Efforts that the motors of a robot can exert as it stands: what force programs, verdicts and the
// motors of a run have in common.
#pragma once
#include "clench/model/world.h"
#include "clench/spec/dof_drive.h"

namespace clench {

/// Efforts that hold the DOF at rest where it stands, by any control that its actuators take;
/// infinite where no limit is given, {0, 0} of a DOF that is not driven [N m or N].
/// RobotDynamics::max_effort replaces limits that are not given.
EffortRange effort_range(const World& world, Id<Robot> robot, int dof);

/// Efforts that its motor can exert at any position and velocity, see DofDrive::limits. Of a DOF that
/// is not driven: those of the motor that a script gives it [N m or N].
EffortRange effort_limits(const World& world, Id<Robot> robot, int dof);

/// Can its motor push the DOF in the direction of its default velocity, at either end of its range?
/// false without such a velocity.
bool can_close(const World& world, Id<Robot> robot, int dof);

/// DOFs whose motors have no limit in some direction.
std::vector<int> unlimited_dofs(const World& world, Id<Robot> robot);

}  // namespace clench
