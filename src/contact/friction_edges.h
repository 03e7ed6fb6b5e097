// Generators of the friction that a contact transmits under a unit normal force, in its frame.
#pragma once
#include "clench/spec/virtual_contact_spec.h"

namespace clench {

/// Generators on the ellipsoid (fx/mu)^2 + (fy/mu)^2 + (tz/(mu e))^2 = 1, divided by mu.
/// torsion_radius  e: the bound on the torque about the normal is e mu force [m]; 0: a point
///                 contact
/// directions      about the normal, 3 or more: all edges of a point contact; for a soft contact
///                 those without torque, while `directions / 4` rings on either side (rounded, 1 to
///                 16) at even latitudes have fewer, in proportion to the length of their circle,
///                 down to one at each pole
/// even_in         unit of length of torques in which latitudes are even [m]; with torsion_radius
///                 itself, the generators are the same at every size
/// returns  6 x directions, or for 8 directions and a soft contact 6 x 20: 1, 5, 8, 5, 1
///          directions, 45 degrees apart; by default with torques in millimeters, like the sets
///          published by others
/// throws   Error if the radius is negative or not finite, or directions are below 3
/// source   Ciocarlie, Miller & Allen (2005), Grasp analysis using deformable fingers, sec. IV
FrictionEdges friction_edges(double torsion_radius = 0, int directions = 8, double even_in = 1e-3);

}  // namespace clench
