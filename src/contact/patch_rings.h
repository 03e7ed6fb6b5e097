// Two surfaces around a contact, over places on circles in the tangent plane.
#pragma once
#include "clench/contact/patch_sheet.h"

namespace clench {

/// Points of a surface, with weights of a fit: the area that a point stands for, less where the
/// surface leans by more than 45 degrees, and none where the sheet ends, so that a flank comes in
/// by and by as it turns towards the contact. Their mean is one.
struct RingPoints {
  std::vector<Eigen::Vector3d> points;  ///< as the body sees them [m]
  std::vector<double> weights;
};

/// The gap between both surfaces over a place.
struct GapPlace {
  Eigen::Vector2d place;  ///< as b sees it [m]
  double area = 0;        ///< that it stands for [m^2]
  double gap = 0;         ///< more than the least; infinite where one of the surfaces is not [m]
};

struct PatchRings {
  std::array<RingPoints, 2> surfaces;  ///< of a and of b
  std::array<double, 2> shares = {};   ///< of the disc that each covers
  std::vector<GapPlace> gap;
};

/// Places on seven circles about the origin, nearer to each other in the middle, more where a
/// surface ends. Each circle is cut where it runs from one triangle to the next, of either body,
/// and has places between the cuts whose sums are integrals: so neither the way that the surfaces
/// are turned nor how a face is cut into triangles tells on them, nor which body comes first.
///
/// a, b    see the plane from both sides: y of a is -y of b, +z goes into each
/// radius  of the largest circle [m]
/// depth   of indentation: places stand nearer to each other where the gap widens by more [m]
PatchRings patch_rings(PatchSheet& a, PatchSheet& b, double radius, double depth);

/// Mean of the products of coordinates over where two surfaces meet when one is pressed into the
/// other by `depth`: places count by exp(-(2 gap / depth)^2), so that no brink tells. 1 / (4
/// sqrt(pi)) of the squared semi-axes where the gap is a paraboloid [m^2].
Eigen::Matrix2d meeting_moments(const std::vector<GapPlace>& gap, double depth);

/// Of two round surfaces over the same places: circles of these curvatures along unit axes, which
/// are columns; hollow counts as flat.
std::vector<GapPlace> round_gap(std::vector<GapPlace> places, const Eigen::Vector2d& curvatures,
                                const Eigen::Matrix2d& axes);

/// How deep one is pressed into the other where the depths over the region where they meet sum to
/// `volume` [m^3]; 0 where they meet nowhere [m].
double depth_of(const std::vector<GapPlace>& gap, double volume);

}  // namespace clench
