// Near points of a round solid and a triangle mesh, or of two round solids.
#pragma once
#include "clench/contact/near_points.h"
#include "clench/geometry/query/round_gap.h"

namespace clench {

/// Points where a mesh comes nearer to a round solid than the threshold [m]: on its faces, edges
/// and corners, each only where it is the nearest to the solid within its neighborhood. p_a and
/// feature_a belong to the mesh; all points are in its frame, and feature_b is not set. Gaps are
/// negative where the solid lies in the mesh, down to the negative of its inner radius.
///
/// round  in the frame of the mesh
/// near   triangles that may be near enough, ascending
std::vector<NearPoint> near_points_of_mesh(const PlacedRound& round, const Shape& mesh,
                                           const std::vector<int>& near, double threshold);

/// Near points of two round solids in one frame; none beyond the threshold [m]. Where a flat part
/// of one lies on a flat part of the other, the outline of the area that they share.
std::vector<NearPoint> near_points_of_rounds(const PlacedRound& a, const PlacedRound& b,
                                             double threshold);

}  // namespace clench
