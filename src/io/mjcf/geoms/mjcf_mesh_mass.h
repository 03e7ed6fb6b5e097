// Mass properties of meshes by the rules of MuJoCo.
#pragma once
#include "clench/geometry/mesh/mass.h"
#include "clench/math/pose.h"

namespace clench {

/// Values of a mesh's attribute `inertia`. `legacy`, MuJoCo's default: the pyramids between the
/// triangles and the centroid of the surface all count as positive, so that parts of a concave mesh
/// count several times. `exact`: the solid. `convex`: the solid of the convex hull. `shell`: the
/// surface.
enum class MeshInertia { legacy, exact, convex, shell };

/// Properties for unit density; for a shell, `volume` is the area [m^2]. If the legacy rule gives
/// the solid's volume, the properties are those of the solid.
/// returns  volume 0 for a mesh without volume (or area)
MassProperties mesh_mass(const Mesh& mesh, MeshInertia rule);

/// Principal axes of an inertia.
struct InertiaAxes {
  Eigen::Quaterniond rotation;  ///< of the axes
  Eigen::Vector3d moments;      ///< in descending order
};
InertiaAxes inertia_axes(const Eigen::Matrix3d& inertia);

}  // namespace clench
