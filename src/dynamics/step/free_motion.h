// Motion of a step without forces of contacts, limits and motors.
#pragma once
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// Places the trees, and computes the accelerations due to gravity, loads, springs, viscous
/// friction, feedforward efforts and inertia: sets trees, forces, v_before and v_free of problem.h.
/// source  Featherstone (2008), Rigid Body Dynamics Algorithms; see tree_dynamics.h
void find_free_motion(const World& world, const System& system, StepProblem& problem);

}  // namespace clench
