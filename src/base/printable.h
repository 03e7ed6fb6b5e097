// Removes characters from text, such as names in files, that a terminal or a page would interpret.
#pragma once
#include <string>
#include <string_view>

namespace clench {

/// Length of the character at byte i of a text in UTF-8 if it is a control character, a line or
/// paragraph separator, or embeds, overrides or isolates the direction of text (U+202A to U+202E,
/// U+2066 to U+2069); else 0 [bytes].
size_t control_size(std::string_view text, size_t i);

/// Overwrites each such character with one '?'; bytes that are not UTF-8 stay.
/// returns  the new end
char* make_printable(char* begin, char* end);
/// The same text with one '?' for each such character. `kept`: those that stay, as in "\n\t"
std::string printable(std::string_view text, std::string_view kept = "");

}  // namespace clench
