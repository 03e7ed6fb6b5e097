// Islands of a step: groups of bodies that act on each other.
#pragma once
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// Sets the islands of a problem whose blocks are known, in the order of their first blocks.
void find_islands(StepProblem& problem);

}  // namespace clench
