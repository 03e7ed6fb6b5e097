// Contact points of two shapes.
#pragma once
#include <vector>

#include "clench/contact/touch.h"
#include "clench/geometry/query/queries.h"

namespace clench {

/// Contact set of two shapes that do not intersect. A patch is a connected set of near points with
/// the same normal; it contributes the corners of its outline, so a box standing on a table touches
/// at four points however its faces are triangulated. Always contains the closest pair, with its
/// bit-exact gap; never loses a patch. Normals run along the gap, or along the face's normal if the
/// gap is too narrow to define a direction. Contacts of round pieces follow from closed formulas.
/// With RoundIn::motion a round piece may penetrate the other shape by less than its inner radius;
/// the gap is then negative.
///
/// where    the purpose for which round pieces must be suitable to be treated as round
/// returns  empty if they are farther apart than the threshold, intersect, or one contains the
///          other
/// throws   Error if an option is negative or not finite, or max_per_patch < 1
std::vector<Touch> contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                               const TouchOptions& options = {}, RoundIn where = RoundIn::all);

}  // namespace clench
