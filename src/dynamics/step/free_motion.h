// How everything moves in a step when no contact, limit or motor acts.
#pragma once
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// Places the trees, and finds what gravity, loads, springs, viscous friction, feedforward efforts
/// and inertia make of their velocities in problem.h: sets trees, forces, v_before and v_free.
/// source  Featherstone (2008), Rigid Body Dynamics Algorithms; see tree_dynamics.h
void find_free_motion(const World& world, const System& system, StepProblem& problem);

}  // namespace clench
