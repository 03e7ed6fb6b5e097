// Tests for contradictory demands on contacts and joints.
#pragma once
#include "clench/dynamics/solve/scaled_friction.h"

namespace clench {

/// Do the laws of a problem possibly contradict each other? false: some impulses r give velocities
/// u = W r + q with u_n >= mu |u_t| at contacts, and with the signs required by infinite bounds in
/// other rows; then there is a solution, except possibly on the very boundary of a cone. true: it
/// is proved that there are no such impulses, as for two opposite limits that both require more.
///
/// source  Acary, Cadoux, Lemaréchal & Malick (2011), A formulation of the linear discrete Coulomb
///         friction problem via convex optimization
bool may_contradict(const ScaledFriction& problem);

}  // namespace clench
