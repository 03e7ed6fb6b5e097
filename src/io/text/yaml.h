// Parses YAML and JSON into a tree of values with their lines. Anchors and multiple documents are
// rejected.
#pragma once
#include <string>
#include <string_view>

#include "clench/io/text/value_tree.h"

namespace clench {

/// A text that begins with a bracket and is valid JSON is read as JSON, which takes little more
/// memory than its tree; all other texts are read as YAML, whose values and lists in brackets are
/// limited to 512 kB.
/// file  the name shown in errors
/// text  trailing white space is ignored
/// throws Error  "g.yaml:3: end of sequence flow not found", in the words of yaml-cpp
ValueTree parse_yaml(const std::string& file, std::string_view text);

/// A text in double quotes, as read by YAML and JSON.
std::string yaml_quoted(std::string_view text);

}  // namespace clench
