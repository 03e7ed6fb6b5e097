// Applies a solved step to its world.
#pragma once
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// Sets velocities, the forces of contacts, motors and limits, and the report. Joints of breakaway
/// DOFs that would transmit more than their clutch allows leave their DOF. Loads are consumed.
void apply_step(World& world, const System& system, StepProblem& problem,
                const StepSolution& solution);

}  // namespace clench
