// Near points of one round solid and a triangle mesh, or another one.
#pragma once
#include "clench/contact/near_points.h"
#include "clench/geometry/query/round_gap.h"

namespace clench {

/// Where a mesh comes nearer to a round solid than the threshold [m]: on its faces, edges and
/// corners, each only where it is the nearest to the solid within its neighbourhood. p_a and
/// feature_a are the mesh's, in its frame; of feature_b nothing is set. Gaps are negative where the
/// solid lies in the mesh, down to its inner radius.
///
/// near  triangles that may come as near, ascending
std::vector<NearPoint> near_points_of_mesh(const PlacedRound& round, const Shape& mesh,
                                           const std::vector<int>& near, double threshold);

/// Of two round solids; nothing beyond the threshold. Solids that lie on each other with a flat
/// side give the outline of what both share.
std::vector<NearPoint> near_points_of_rounds(const PlacedRound& a, const PlacedRound& b,
                                             double threshold);

}  // namespace clench
