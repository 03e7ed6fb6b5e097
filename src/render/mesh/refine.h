// Triangle corners made fine enough to carry light and to be sorted, and shared again.
#pragma once
#include <vector>

#include "clench/render/mesh/corner.h"

namespace clench {

/// Corners, three a triangle: halves every edge longer than `longest` [scene units], and its
/// neighbor's with it, so that no cracks open. Outside the scene's ball edges may be longer, in
/// proportion to the distance.
/// on_image  do the corners have places in an image?
std::vector<Corner> split_long_edges(const std::vector<Corner>& corners, float longest,
                                     bool on_image = false);

/// The length to which edges can be split without making more than `most` triangles: `longest`, or
/// a larger one.
float affordable_length(const std::vector<Corner>& corners, float longest, size_t most);

/// Appends corners, three a triangle, each distinct one once, and their indices among those.
void append_shared(const std::vector<Corner>& corners, std::vector<Corner>& shared,
                   std::vector<uint32_t>& indices);

}  // namespace clench
