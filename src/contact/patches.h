// Near points reduced to the corners of flat patches.
#pragma once
#include <vector>

#include "clench/contact/near_points.h"

namespace clench {

/// Cosine above which two normals belong to one flat patch: 2.6 degrees.
inline constexpr double same_normal = 1 - 1e-3;

/// Merges regions with the same normal that come within `reach` [m] of each other: meshes have
/// cracks.
void join_neighbors(std::vector<NearPoint>& points, double reach);

/// Indices of the points that are kept, ascending. A patch is formed by the points of a region that
/// share a normal: it keeps its closest point and the corners of its outline.
/// merge          points of a patch nearer than this are merged [m]
/// max_per_patch  longer outlines are thinned
/// rounding       of coordinates [m]
std::vector<int> patch_corners(std::vector<NearPoint>& points, double merge, int max_per_patch,
                               double rounding);

}  // namespace clench
