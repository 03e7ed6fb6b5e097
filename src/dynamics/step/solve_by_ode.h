// Solves a step with ODE, the Open Dynamics Engine.
#pragma once
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// Solves the same contacts, motors and limits for the velocities and impulses of ODE; see
/// ode/ode_step.h.
/// throws  Error if ODE rejects a body or returns a value that is not finite, and for more than
///         1,000 contact points: nothing can interrupt Dantzig's method, whose time grows with the
///         cube of their number
StepSolution solve_by_ode(const World& world, const System& system, const StepProblem& problem);

}  // namespace clench
