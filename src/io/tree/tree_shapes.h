// Meshes of the primitive shapes in robot files. All are closed, centered, and face outward; round
// ones have their vertices on the true surface.
#pragma once
#include "clench/geometry/mesh/mass.h"

namespace clench {

/// Edges of a full circle: the error is below 0.05 mm for a radius of 1 cm.
inline constexpr int circle_edges = 32;

/// edges of the given lengths [m]
Mesh box_mesh(const Eigen::Vector3d& size);

/// about z
Mesh cylinder_mesh(double radius, double length);

/// A cylinder about z with a hemisphere at each end; `length` [m] is that of the cylinder. 0: a
/// ball.
Mesh capsule_mesh(double radius, double length);

Mesh ellipsoid_mesh(const Eigen::Vector3d& radii);

/// For the true solids, which are larger than these meshes.
MassProperties cylinder_solid(double radius, double length);
MassProperties capsule_solid(double radius, double length);
MassProperties ellipsoid_solid(const Eigen::Vector3d& radii);

/// For their surfaces with uniformly distributed mass: `volume` is the area [m^2]. The ellipsoid's
/// area is approximate, within 1.1 %, and its inertia is that of a thin shell between it and an
/// ellipsoid with radii larger by equal amounts.
/// source  K. Thomsen (2004), p = 1.6075, for the area
MassProperties box_shell(const Eigen::Vector3d& size);
MassProperties cylinder_shell(double radius, double length);
MassProperties capsule_shell(double radius, double length);
MassProperties ellipsoid_shell(const Eigen::Vector3d& radii);

}  // namespace clench
