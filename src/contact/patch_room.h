// How wide two surfaces are around a contact, and the ellipses that find room on them.
#pragma once
#include "clench/contact/patch_sheet.h"

namespace clench {

/// Half widths of surfaces along unit directions of the tangent plane, as seen from b: across
/// the sides of the convex hulls, which bound the width in every other direction.
struct PatchRoom {
  std::vector<Eigen::Vector2d> directions;
  std::vector<double> half_widths;  ///< [m]
};

/// Half widths of one surface, as patch_rings gives it.
/// is_a  the surface is that of a, where the tangent plane is mirrored
PatchRoom patch_room(const PatchSheet& sheet, bool is_a);
/// Half widths of both surfaces.
PatchRoom operator+(PatchRoom one, const PatchRoom& other);

/// The ellipse may lie anywhere on the surfaces, so in no direction is it wider than they are: it
/// shrinks as it is until it finds room, and then grows again along either axis as far as there is
/// some.
///
/// axes   unit, columns
/// grows  false where the axes are any, as of a circle
std::array<double, 2> make_room(const PatchRoom& room, const Eigen::Matrix2d& axes,
                                const std::array<double, 2>& semi_axes, bool grows);

}  // namespace clench
