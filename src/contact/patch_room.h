// How wide two surfaces are around a contact, and the ellipses that find room on them.
#pragma once
#include "clench/contact/patch_sheet.h"

namespace clench {

/// Half of how wide surfaces are along unit directions of the tangent plane as b sees it, across
/// the sides of their hulls: in others they are no narrower than these make them.
struct PatchRoom {
  std::vector<Eigen::Vector2d> directions;
  std::vector<double> half_widths;  ///< [m]
};

/// Of one surface, as patch_rings has it.
/// is_a  it is that of a, which sees the plane from the other side
PatchRoom patch_room(const PatchSheet& sheet, bool is_a);
/// Of two surfaces together.
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
