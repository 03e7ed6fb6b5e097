// Mass properties of the solid or the surface that a mesh bounds.
#pragma once
#include <Eigen/Core>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

struct MassProperties {
  double volume = 0;  ///< signed, > 0 when triangles face outward [m^3]
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< of the volume [m]
  /// about the centroid, for unit mass and uniform density [m^2]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// Exact integrals over the solid (uniform density). Meaningful only for closed meshes.
/// source  Mirtich (1996); Eberly (2002), polyhedral mass properties
MassProperties solid_mass(const Mesh& mesh);

/// Reverses the triangles of a closed mesh that is inside out, so that they face outward.
/// returns  true if it was inside out
bool turn_outward(Mesh& mesh);
/// Note on such a mesh, printed after its name.
inline constexpr const char* inside_out = ": its triangles face inward; flipped to face outward";

/// Area-weighted centroid of the surface [m].
Eigen::Vector3d surface_centroid(const Mesh& mesh);

/// Largest distance of a surface point from p [m].
double largest_radius(const Mesh& mesh, const Eigen::Vector3d& p);

}  // namespace clench
