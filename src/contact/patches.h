// Near points reduced to the corners of flat patches.
#pragma once
#include <vector>

#include "clench/contact/near_points.h"

namespace clench {

/// Regions that come as near as `reach` [m] with the same normal become one: meshes have cracks.
void join_neighbours(std::vector<NearPoint>& points, double reach);

/// The points that stay, as ascending indices. A patch is what has one normal, to 2.6 degrees,
/// within a region: it keeps its closest point and the corners of its outline.
/// merge          points of a patch nearer than this are one [m]
/// max_per_patch  a longer outline is thinned
/// rounding       of coordinates [m]
std::vector<int> patch_corners(std::vector<NearPoint>& points, double merge, int max_per_patch,
                               double rounding);

}  // namespace clench
