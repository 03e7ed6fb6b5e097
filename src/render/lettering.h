// Letters as strokes on a grid, to write on pictures: no font of others is needed.
#pragma once
#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace clench {

/// Lines from point to point on a grid of 5 x 9: x from 0 to 4, y up from 0, baseline at 2, capitals
/// up to 8. A line of one point is a dot. A character that is not known is an open box.
using Strokes = std::vector<std::vector<Eigen::Vector2f>>;
Strokes strokes_of(char character);

inline constexpr float letter_advance = 6;  ///< from letter to letter on the grid
inline constexpr float letter_baseline = 2;
inline constexpr float letter_top = 8;

}  // namespace clench
