#include "clench/io/text/xml_scan.h"

#include <algorithm>
#include <utility>

namespace clench {

int line_at(std::string_view text, size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + at, '\n'));
}

size_t skip_other(std::string_view text, size_t at) {
  constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}};
  for (const auto& [begin, end] : others) {
    if (!text.substr(at).starts_with(begin)) continue;
    const size_t found = text.find(end, at + begin.size());
    return found == std::string_view::npos ? text.size() : found + end.size();
  }
  return 0;
}

Tag scan_tag(std::string_view text, size_t at) {
  Tag tag;
  char quote = 0;
  for (tag.end = at + 1; tag.end < text.size(); ++tag.end) {
    const char c = text[tag.end];
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '=') {
      ++tag.attributes;
    } else if (c == '>') {
      break;
    }
  }
  tag.closed = tag.end < text.size() && text[tag.end - 1] == '/';
  return tag;
}

}  // namespace clench
