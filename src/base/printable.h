// Text from files, such as names, where it is shown: a terminal or a page would obey part of it.
#pragma once
#include <string>
#include <string_view>

namespace clench {

/// Bytes of the character at i of a text in UTF-8 if it is one that is obeyed rather than shown,
/// else 0. Control characters, line and paragraph separators, and characters that embed, override
/// or isolate the direction of text (U+202A to U+202E, U+2066 to U+2069) are.
size_t control_size(std::string_view text, size_t i);

/// Overwrites each such character with one '?'; bytes that are not UTF-8 stay.
/// returns  the new end
char* make_printable(char* begin, char* end);
/// The same text with one '?' for each such character.   `kept`: those that stay, as in "\n\t"
std::string printable(std::string_view text, std::string_view kept = "");

}  // namespace clench
