// XML looked at tag by tag, before or instead of being parsed.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace clench {

int line_at(std::string_view text, size_t at);  ///< from 1

/// Past the end of what begins at `at` and is no element's tag: comment, CDATA, declaration; else 0.
size_t skip_other(std::string_view text, size_t at);

struct Tag {
  size_t end = 0;  ///< of its '>', or of the text
  int attributes = 0;
  bool closed = false;
};

/// The tag that begins at `at`.
Tag scan_tag(std::string_view text, size_t at);

struct XmlFault {
  int line = 1;
  std::string sentence;  ///< "expected </mass>, which closes the <mass> of line 2, got </mess>"
};

/// What is wrong first with the tags of a text that is no well-formed XML; empty when that is
/// something else. Comments, CDATA and declarations are passed over.
std::optional<XmlFault> find_xml_fault(std::string_view text);

}  // namespace clench
