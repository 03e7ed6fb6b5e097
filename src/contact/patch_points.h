// Points of a body's surface around a contact, spread evenly whatever its triangles are.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "geometry/shape.h"
#include "math/pose.h"

namespace clench {

/// Places in the tangent plane: a square lattice about the origin, those within `radius` of a site.
struct PatchLattice {
  double radius = 0;                    ///< > 0 [m]
  double spacing = 0;                   ///< [m]
  std::vector<Eigen::Vector2d> places;  ///< by rows: y, then x [m]
  std::vector<Eigen::Vector2i> cells;   ///< place = cell * spacing
};

PatchLattice patch_lattice(std::span<const Eigen::Vector2d> sites, double radius);

/// The surface over each place, straight down along z; empty where there is none. Only the sheet
/// that holds the contacts: the triangles that hang together with those nearest to the sites and
/// face the contact, leaning less than 73 degrees. So a thin plate has no far side, and a fine mesh
/// no more points than a coarse one.
///
/// Between the vertices a surface is taken for round where neighbouring triangles lean from each
/// other by less than 40 degrees, flat at sharper edges: there points lie on the curved surface
/// whose normals the triangles around the vertices tell, not on its chords.
///
/// X_PB   body in the frame of the patch, whose +z goes into the body
/// sites  about where the contacts are, frame P [m]
/// source Boubekeur & Alexa (2008), Phong tessellation (with half a step, which makes it exact to
///        second order); Max (1999), Weights for computing vertex normals from facet normals
std::vector<std::optional<Eigen::Vector3d>> patch_points(const Shape& shape, const Pose& X_PB,
                                                         std::span<const Eigen::Vector3d> sites,
                                                         const PatchLattice& lattice);

}  // namespace clench
