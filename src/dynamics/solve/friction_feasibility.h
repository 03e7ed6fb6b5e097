// Tests for contradictory demands on contacts and joints.
#pragma once
#include "clench/dynamics/solve/scaled_friction.h"

namespace clench {

/// false: some velocities u = W r + q, whatever r, are such that nothing holds them up: u_n >= mu
/// |u_t| at contacts, within what an infinite bound asks for in other rows. Then, but for the
/// cone's very boundary, there is a solution. true: it is proved that there are none, as with two
/// opposite limits that both ask for the other side.
///
/// source  Acary, Cadoux, Lemaréchal & Malick (2011), A formulation of the linear discrete Coulomb
///         friction problem via convex optimization
bool may_contradict(const ScaledFriction& problem);

}  // namespace clench
