// Sets of points that isometries carry onto themselves reach equally far along a direction and along its
// images. A cone of directions that holds an image of each tells all that the set's least support needs:
// of a ring of 16 contacts one part in 64. Includes no Eigen.
// source  Bremner, Dutour Sikiric, Pasechnik, Rehn & Schuermann (2014), Computing symmetry groups of polyhedra
#pragma once
#include "grasp/point_classes.h"
#include "grasp/support_set.h"

namespace clench {

/// The directions that are nearer to a centre than to the centre's nearest images; all directions when no
/// isometry but the identity is found.
DirectionCone symmetry_cone(const TellingPoints& points);

}  // namespace clench
