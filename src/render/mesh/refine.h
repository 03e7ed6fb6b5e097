// Refinement of triangles, fine enough for light per corner and for depth sorting, and sharing of
// corners.
#pragma once
#include <vector>

#include "clench/render/mesh/corner.h"

namespace clench {

/// Takes three corners per triangle: halves every edge longer than `longest` [scene units],
/// together with its neighbor's, so that no cracks open. Outside the scene's ball edges may be
/// longer, in proportion to the distance.
/// on_image  do the corners have image coordinates?
std::vector<Corner> split_long_edges(const std::vector<Corner>& corners, float longest,
                                     bool on_image = false);

/// Edge length that refinement reaches without exceeding `most` triangles: `longest`, or larger.
float affordable_length(const std::vector<Corner>& corners, float longest, size_t most);

/// Appends corners, three per triangle, each distinct one once, and their indices among those.
void append_shared(const std::vector<Corner>& corners, std::vector<Corner>& shared,
                   std::vector<uint32_t>& indices);

}  // namespace clench
