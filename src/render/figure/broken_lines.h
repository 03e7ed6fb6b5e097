// Breaks texts into lines.
#pragma once
#include <string>
#include <vector>

#include "clench/render/figure/lettering.h"

namespace clench {

/// Breaks a text between words, so that no line is wider than `width`, except one of a single word.
/// height  of capital letters; width: of a line [pixels]
std::vector<std::string> broken_lines(const std::string& text, float height, float width,
                                      const Font& font);

}  // namespace clench
