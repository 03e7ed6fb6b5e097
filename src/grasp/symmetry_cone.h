// Sets of points that isometries carry onto themselves reach equally far along a direction and along its
// images. A cone of directions that holds an image of each tells all that the set's least support needs:
// of a ring of 16 contacts one part in 64. Includes no Eigen.
// source  Bremner, Dutour Sikiric, Pasechnik, Rehn & Schuermann (2014), Computing symmetry groups of polyhedra
#pragma once
#include <span>

#include "grasp/support_set.h"

namespace clench {

/// Points that tell a set of size about one: the set is their hull, or has parts, each told by points.
struct TellingPoints {
  int dimension = 0, count = 0, stride = 0;
  const double* coordinates = nullptr;  ///< point i has coordinates[k * stride + i], k < dimension
  /// Of which part each point is, point after point; isometries carry parts one to one. Empty: no parts.
  std::span<const int> parts;
};

/// The directions that are nearer to a centre than to the centre's nearest images; all directions when no
/// isometry but the identity is found.
DirectionCone symmetry_cone(const TellingPoints& points);

}  // namespace clench
