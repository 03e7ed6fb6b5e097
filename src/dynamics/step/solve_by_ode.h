// Solves a step with ODE, the Open Dynamics Engine.
#pragma once
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// The same contacts, motors and limits, with velocities and impulses that ODE finds; see
/// ode/ode_step.h.
/// throws  Error when ODE refuses a body or gives what is no number, and for more than 1,000 contact
///         points: nothing can stop Dantzig's method, whose time grows with the cube of their number
StepSolution solve_by_ode(const World& world, const System& system, const StepProblem& problem);

}  // namespace clench
