// XML looked at tag by tag, before or instead of being parsed.
#pragma once
#include <string_view>

namespace clench {

int line_at(std::string_view text, size_t at);  ///< from 1

/// Past the end of what begins at `at` and is no element's tag: comment, CDATA, declaration; else
/// 0.
size_t skip_other(std::string_view text, size_t at);

struct Tag {
  size_t end = 0;  ///< of its '>', or of the text
  int attributes = 0;
  bool closed = false;
};

/// The tag that begins at `at`.
Tag scan_tag(std::string_view text, size_t at);

}  // namespace clench
