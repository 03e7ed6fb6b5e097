// Nodes of an Inventor or VRML file.
#pragma once
#include <deque>
#include <set>

#include "clench/base/diagnostic.h"
#include "clench/io/inventor/inventor_types.h"

namespace clench {

/// A node is read once and shared by all places that refer to it by USE.
struct InventorNode {
  const InventorType* type = nullptr;
  int file = 0;  ///< index into InventorGraph::files
  int line = 0;
  int height = 1;  ///< of the subtree, including this node
  /// only those in the file
  std::vector<std::pair<const InventorField*, InventorValue>> values = {};
  /// Children of a group. For an Inventor shape in old files, nodes inside it that apply only to
  /// it.
  std::vector<const InventorNode*> children = {};

  // value of a field of the type, or its default
  const std::vector<float>& numbers(std::string_view field) const;
  const std::vector<int32_t>& integers(std::string_view field) const;
  const std::vector<std::string>& words(std::string_view field) const;
  float number(std::string_view field) const { return numbers(field)[0]; }
  int32_t integer(std::string_view field) const { return integers(field)[0]; }
  const std::string& word(std::string_view field) const { return words(field)[0]; }
  const InventorNode* node(std::string_view field) const;  ///< null if there is none
};

/// Diagnostics for the caller, without duplicates, up to a limit.
class InventorWarnings {
 public:
  /// `file`: the file named in the message that further warnings are left out
  void add(const std::string& file, Diagnostic diagnostic);
  const std::vector<Diagnostic>& list() const { return list_; }

 private:
  std::vector<Diagnostic> list_;
  std::set<std::string> warned_;
};

struct InventorGraph {
  std::deque<InventorNode> nodes;
  const InventorNode* root = nullptr;
  std::deque<std::string> files;  ///< names; the first is the file itself
  size_t bytes = 0;               ///< of all files, each counted once
  InventorWarnings warnings;      ///< of contents that are not used
  InventorWarnings repairs;       ///< of invalid contents that were repaired

  /// Place of a node for messages: "box.iv:31", or "box.iv: part.iv:31" in an included file.
  Place place(const InventorNode& node) const;
};

/// Makes negative sizes positive and clamps complexities to 0..1; reports this, and also sizes and
/// factors of 0, arrays without copies, and switches to a missing child.
void repair_values(InventorNode& node, InventorGraph& graph);

}  // namespace clench
