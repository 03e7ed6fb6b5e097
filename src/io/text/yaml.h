// YAML, and JSON, which is a part of it, as a tree that knows its lines. Anchors and several
// documents are refused.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clench/base/error.h"

namespace clench {

/// A value of such a file and where it stands.
struct YamlNode {
  enum class Kind { scalar, list, map };

  Kind kind = Kind::scalar;
  std::string text = {};  ///< of a scalar, without its quotes
  bool quoted = false;
  int line = 0;
  std::vector<YamlNode> items = {};    ///< of a list, or the values of a map
  std::vector<std::string> keys = {};  ///< of a map, in their order

  /// null: the map has no such key, or this is no map
  const YamlNode* find(std::string_view key) const;
  /// For a message: the scalar in quotes, else "a list of 3", "a map".
  std::string described() const;
};

/// file  the name shown in errors
/// text  white space at its end does not count
/// throws Error  "g.yaml:3: end of sequence flow not found", in the words of yaml-cpp
YamlNode parse_yaml(const std::string& file, std::string_view text);

/// A text in double quotes, as YAML and JSON read it.
std::string yaml_quoted(std::string_view text);

}  // namespace clench
