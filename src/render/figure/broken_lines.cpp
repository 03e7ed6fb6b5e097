#include "clench/render/figure/broken_lines.h"

#include <algorithm>

namespace clench {

std::vector<std::string> broken_lines(const std::string& text, float height, float width,
                                      const Font& font) {
  std::vector<std::string> lines;
  for (size_t from = 0; from <= text.size();) {
    const size_t end = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, end - from);
    if (!lines.empty() && font.width(lines.back() + ' ' + word, height) <= width)
      lines.back() += ' ' + word;
    else
      lines.push_back(word);
    from = end + 1;
  }
  return lines;
}

}  // namespace clench
