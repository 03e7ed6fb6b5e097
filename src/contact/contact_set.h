// Where two shapes touch.
#pragma once
#include <vector>

#include "clench/contact/touch.h"
#include "clench/geometry/query/queries.h"

namespace clench {

/// Contact set of two shapes that do not intersect. A patch is where near points with one normal
/// hang together; it gives the corners of its outline, so a box standing on a table touches at four
/// points however its faces are cut into triangles. Always contains the closest pair (its gap to
/// the bit); never loses a patch. Normals run along the gap; where it is too narrow to tell a
/// direction, along the face's normal. Contacts of round pieces follow from their formulas. With
/// RoundIn::motion a round piece may lie in the other shape by less than its inner radius; the gap
/// is then negative.
///
/// where    where round pieces must count to be treated as round
/// returns  nothing when they are farther apart than the threshold, intersect, or one holds the
///          other
/// throws   Error when an option is negative or not finite, or max_per_patch < 1
std::vector<Touch> contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                               const TouchOptions& options = {}, RoundIn where = RoundIn::all);

}  // namespace clench
