// Joints that leave their breakaway DOF.
#pragma once
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// A joint of a breakaway DOF leaves it when the step has transmitted more than its clutch allows,
/// in the DOF's closing direction. The last joint that follows a DOF stays.
/// problem  solved: velocities of its trees change
/// v        of all coordinates at the end of the step [m/s, rad/s]
void disengage_joints(World& world, const System& system, StepProblem& problem,
                      const Eigen::VectorXd& v);

}  // namespace clench
