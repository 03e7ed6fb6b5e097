// JSON (RFC 8259) as a tree of values.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "clench/io/text/value_tree.h"

namespace clench {

/// Error in a JSON text: its place and message.
struct JsonFault {
  int line = 0;
  std::string sentence;  ///< "expected ',' or ']', got 'x'"
};

/// Adds the text to an empty tree. Numbers, true and false are stored as scalars as written, null
/// as an empty scalar.
/// returns  the error in the text; empty: the tree is complete
/// throws   Error as ValueTree does
std::optional<JsonFault> read_json_tree(std::string_view text, ValueTree& out);

}  // namespace clench
