// Triangle corners made fine enough to carry light and to be sorted, and shared again.
#pragma once
#include <vector>

#include "clench/render/mesh/corner.h"

namespace clench {

/// Corners, three a triangle: halves every edge longer than `longest` [scene units], and its
/// neighbor's with it, so that no cracks open. Outside the scene's ball edges may be longer, in
/// proportion to the distance. Gives up the length, not the count, when there would be more than
/// `most` triangles.
std::vector<Corner> split_long_edges(const std::vector<Corner>& corners, float longest,
                                     size_t most);

/// Appends corners, three a triangle, each distinct one once, and their indices among those.
void append_shared(const std::vector<Corner>& corners, std::vector<Corner>& shared,
                   std::vector<uint32_t>& indices);

}  // namespace clench
