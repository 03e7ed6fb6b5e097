// Motion of one step, which ends early at a collision.
#pragma once
#include "clench/dynamics/tree/articulation.h"

namespace clench {

/// Moves everything with its velocity until dt has passed [s] or two approaching bodies touch.
/// Manifolds are up to date afterwards.
/// returns  the time that has passed, in (0, dt] [s]
double move_until_meeting(World& world, const System& system, double dt);

}  // namespace clench
