// Points of a body's surface around a contact, spread evenly whatever its triangles are.
#pragma once
#include "contact/patch_sheet.h"

namespace clench {

/// Places in the tangent plane: a square lattice about the origin, those within `radius` of a site.
struct PatchLattice {
  double radius = 0;                    ///< > 0 [m]
  double spacing = 0;                   ///< [m]
  std::vector<Eigen::Vector2d> places;  ///< by rows: y, then x [m]
  std::vector<Eigen::Vector2i> cells;   ///< place = cell * spacing
};

/// throws  Error when sites lie farther apart than the lattice can count
PatchLattice patch_lattice(std::span<const Eigen::Vector2d> sites, double radius);

/// With weights for a fit: 1 where the surface leans less than 45 degrees, 0 where the sheet ends, so
/// that a flank comes in by and by as it turns towards the contact.
struct PatchPoints {
  std::vector<Eigen::Vector3d> points;  ///< [m]
  std::vector<double> weights;
};

/// The surface over the places, straight along z. A fine mesh has no more points than a coarse one.
PatchPoints patch_points(PatchSheet& sheet, const PatchLattice& lattice);

/// Barycentric weights of the point of a triangle over a place; false where there is none. Edges belong
/// to both sides.
bool weights_over(const Corners& corners, const Eigen::Vector2d& place, Eigen::Vector3d& weights);

/// A place on a triangle of a sheet.
struct PatchHit {
  int triangle = -1;  ///< -1: on none
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  double z = 0;

  /// takes a triangle where that lies nearer to the tangent plane: a sheet may lie over itself
  void offer(const PatchSheet& sheet, int candidate, const Eigen::Vector3d& at);
};

}  // namespace clench
