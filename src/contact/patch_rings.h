// Samples of two surfaces around a contact, over positions on circles in the tangent plane.
#pragma once
#include "clench/contact/patch_sheet.h"

namespace clench {

/// Points of a surface, with weights for a fit: the area that a point represents, reduced where the
/// surface leans by more than 45 degrees, and zero at the end of the sheet, so that a flank is
/// included gradually as it turns towards the contact. The mean weight is one.
struct RingPoints {
  std::vector<Eigen::Vector3d> points;  ///< in the body's view of the plane [m]
  std::vector<double> weights;
};

/// The gap between both surfaces over a position.
struct GapPlace {
  Eigen::Vector2d place;  ///< in b's view of the plane [m]
  double area = 0;        ///< area that it represents [m^2]
  double gap = 0;  ///< in excess of the smallest gap; infinite if one of the surfaces is absent [m]
};

struct PatchRings {
  std::array<RingPoints, 2> surfaces;  ///< of a and of b
  std::array<double, 2> shares = {};   ///< fraction of the disc that each covers
  std::vector<GapPlace> gap;
};

/// Positions on seven circles about the origin, denser near the center and where a surface ends.
/// Each circle is cut where it passes from one triangle to the next, of either body, and has
/// quadrature nodes between the cuts: so the result does not depend on the rotation of the
/// surfaces, on the triangulation of a face, or on the order of the bodies.
///
/// a, b    see the plane from both sides: y of a is -y of b, +z points into each
/// radius  of the largest circle [m]
/// depth   of indentation: positions are denser where the gap widens by more [m]
PatchRings patch_rings(PatchSheet& a, PatchSheet& b, double radius, double depth);

/// Mean of the products of coordinates over the region in which two surfaces touch if one is
/// pressed into the other by `depth`: positions have the weight exp(-(2 gap / depth)^2), so that
/// there is no sharp border. For a gap that is a paraboloid it is 1 / (4 sqrt(pi)) of the squared
/// semi-axes [m^2].
Eigen::Matrix2d meeting_moments(const std::vector<GapPlace>& gap, double depth);

/// The same for two round surfaces over the same positions: circles of these curvatures along unit
/// axes, which are columns; concave counts as flat.
std::vector<GapPlace> round_gap(std::vector<GapPlace> places, const Eigen::Vector2d& curvatures,
                                const Eigen::Matrix2d& axes);

/// Indentation at which the depths over the contact region integrate to `volume` [m^3]; 0 if the
/// surfaces touch nowhere [m].
double depth_of(const std::vector<GapPlace>& gap, double volume);

}  // namespace clench
