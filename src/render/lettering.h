// Letters as strokes on a grid, to write on pictures: no font of others is needed.
#pragma once
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace clench {

/// Lines from point to point on a grid of 5 x 9: x from 0 to 4, y up from 0, baseline at 2, capitals
/// up to 8, their accents up to 9. A line of one point is a dot. Latin and Greek are known, and some
/// signs; any other letter is an open box.
using Strokes = std::vector<std::vector<Eigen::Vector2f>>;
Strokes strokes_of(char32_t letter);

/// The letters of text in UTF-8; each byte that belongs to none is U+FFFD.
std::u32string letters_of(std::string_view text);

/// Letters as UTF-8.
std::string text_of(std::u32string_view word);

/// Letters of a text that are drawn as boxes, each once.
std::u32string unknown_letters(std::string_view text);

inline constexpr float letter_advance = 6;  ///< from letter to letter on the grid
inline constexpr float letter_baseline = 2;
inline constexpr float letter_top = 8;

}  // namespace clench
