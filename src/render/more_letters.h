// The strokes of letters beyond ASCII: Latin with its accents, Greek, some signs.
#pragma once
#include <string_view>

namespace clench {

/// A letter as another one, which has strokes of its own, and an accent; a space is none.
struct AccentedLetter {
  char32_t letter, base, accent;
};

/// Strokes as text, in the form of lettering.cpp; null when there are none.
const std::string_view* more_strokes(char32_t letter);
/// Null when it is no such letter.
const AccentedLetter* accented_letter(char32_t letter);
/// Above a small letter, whose top is at 6, or below; null when it is no accent.
const std::string_view* accent_strokes(char32_t accent);

}  // namespace clench
