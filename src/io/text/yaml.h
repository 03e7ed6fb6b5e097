// YAML and JSON as a tree of values that know their lines. Anchors and several documents are
// refused.
#pragma once
#include <string>
#include <string_view>

#include "clench/io/text/value_tree.h"

namespace clench {

/// A text that begins with a bracket is read as JSON if it is, in little more memory than its tree takes;
/// everything else as YAML, whose values and lists in brackets have at most 512 kB.
/// file  the name shown in errors
/// text  white space at its end does not count
/// throws Error  "g.yaml:3: end of sequence flow not found", in the words of yaml-cpp
ValueTree parse_yaml(const std::string& file, std::string_view text);

/// A text in double quotes, as YAML and JSON read it.
std::string yaml_quoted(std::string_view text);

}  // namespace clench
