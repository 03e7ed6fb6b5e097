// Widths of two surfaces around a contact, and the ellipses that fit on them.
#pragma once
#include "clench/contact/patch_sheet.h"

namespace clench {

/// Half widths of surfaces along unit directions of the tangent plane, in b's view: across the
/// sides of the convex hulls, which bound the width in every other direction.
struct PatchWidth {
  std::vector<Eigen::Vector2d> directions;
  std::vector<double> half_widths;  ///< [m]
};

/// Half widths of one surface, sampled by patch_rings.
/// is_a  the surface is that of a, for which the tangent plane is mirrored
PatchWidth patch_width(const PatchSheet& sheet, bool is_a);
/// Half widths of both surfaces.
PatchWidth operator+(PatchWidth one, const PatchWidth& other);

/// Shrinks an ellipse uniformly until no direction of it is wider than the surfaces, on which it
/// may lie anywhere; then enlarges it along either axis as far as it fits.
///
/// axes   unit, columns
/// grows  false if the axes are arbitrary, as of a circle
std::array<double, 2> make_room(const PatchWidth& room, const Eigen::Matrix2d& axes,
                                const std::array<double, 2>& semi_axes, bool grows);

}  // namespace clench
