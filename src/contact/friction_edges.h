// The friction that a contact can carry under a unit normal force, as a few generators in its
// frame.
#pragma once
#include "clench/spec/virtual_contact_spec.h"

namespace clench {

/// Generators on the ellipsoid (fx/mu)^2 + (fy/mu)^2 + (tz/(mu e))^2 = 1, divided by mu.
/// torsion_radius  e: how far the bound on the torque about the normal goes, torque = e mu force
///                 [m]; 0: a point
/// directions      about the normal, 3 or more: all of a point's edges; of a soft contact those
///                 without torque, while `directions / 4` rings either side (rounded, 1 to 16) at
///                 even latitudes have fewer, as their circle is shorter, down to one at each pole
/// even_in         the length in which torques are measured where latitudes are even [m];
///                 torsion_radius itself: the same generators at every size
/// returns  6 x directions, or for 8 directions and a soft contact 6 x 20: 1, 5, 8, 5, 1
///          directions, 45 degrees apart; by default where the torque is measured in millimetres,
///          as in the sets that others have made
/// throws   Error when the radius is negative or not finite, or directions are below 3
/// source   Ciocarlie, Miller & Allen (2005), Grasp analysis using deformable fingers, sec. IV
FrictionEdges friction_edges(double torsion_radius = 0, int directions = 8, double even_in = 1e-3);

}  // namespace clench
