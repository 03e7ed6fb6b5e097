// The text of an Inventor or VRML file, looked through before the reader library sees it: the
// library trusts its input further than we do.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clench {

/// A File node: another file that stands in its place.
struct InventorInclude {
  std::string name;  ///< as written
  int line = 0;
};

struct InventorText {
  std::string text;       ///< for the library; line n of it is line n + skipped_lines of the file
  int skipped_lines = 0;  ///< lines before the header
  /// Types of the nodes in it and their lines, in order; empty where PROTOs make nodes of their own.
  std::vector<std::pair<std::string, int>> nodes;
  std::vector<InventorInclude> includes;  ///< number i is called include_key(i) in `text`
  std::vector<std::string> warnings;      ///< "box.iv:7: unknown node 'Foo' is skipped"
};

/// Files included, each counted as often as it is named: far above what models name.
inline constexpr size_t most_includes = 10'000;

/// What a File node's name is replaced by.
std::string include_key(int number);

/// idle: without effect on triangles and colours; shape: takes nodes only as values of its fields
enum class NodeType { known, shape, idle, unknown };

/// Checks header, brackets, strings and names; cuts out nodes that are idle or of unknown type, and
/// routes. What stands inside a shape, as in old files, is lifted to stand before it, for it alone.
/// `file` is the name shown in errors, `node_type` tells what the library knows by a name.
/// throws Error  "box.iv:31: '}' missing for 'Separator' of line 4", and so on
InventorText scan_inventor(const std::string& text, const std::string& file,
                           const std::function<NodeType(const std::string&)>& node_type);

}  // namespace clench
