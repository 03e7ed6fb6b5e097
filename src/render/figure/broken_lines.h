// A text as lines of a width.
#pragma once
#include <string>
#include <vector>

#include "clench/render/figure/lettering.h"

namespace clench {

/// Breaks a text between words where a line would be wider than `width`; a single word may be.
/// height  of capital letters; width: of a line [pixels]
std::vector<std::string> broken_lines(const std::string& text, float height, float width,
                                      const Font& font);

}  // namespace clench
