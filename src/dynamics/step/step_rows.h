// Contacts, limits, motors and friction as the rows of a step.
#pragma once
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// Adds the rows that the world's manifolds and the settings of its robots require, given the free
/// motion: sets everything of the problem that find_free_motion does not.
/// source  Anitescu & Hart (2004), A constraint-stabilized time-stepping approach for rigid
///         multibody dynamics with joints, contact and friction, for gaps in the right-hand side
void find_rows(const World& world, const System& system, StepProblem& problem);

}  // namespace clench
