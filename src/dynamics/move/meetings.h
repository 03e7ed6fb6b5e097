// The motion of one step, which ends early where bodies meet.
#pragma once
#include "clench/dynamics/tree/articulation.h"

namespace clench {

/// Moves everything by its velocity until dt has passed [s] or two bodies that approach each other
/// touch. Manifolds are up to date afterwards.
/// returns  the time that has passed, in (0, dt] [s]
double move_until_meeting(World& world, const System& system, double dt);

}  // namespace clench
