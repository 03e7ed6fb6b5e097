// The nodes of an Inventor or VRML file.
#pragma once
#include <deque>
#include <set>

#include "clench/base/diagnostic.h"
#include "clench/io/inventor/inventor_types.h"

namespace clench {

/// Read once; it stands at every place where USE names it.
struct InventorNode {
  const InventorType* type = nullptr;
  int file = 0;  ///< of InventorGraph::files
  int line = 0;
  int height = 1;  ///< nodes above one another, itself and all below
  std::vector<std::pair<const InventorField*, InventorValue>> values = {};  ///< those given
  /// Of a group; of an Inventor shape what stands inside it, as in old files, for it alone.
  std::vector<const InventorNode*> children = {};

  // what a field of the type holds, given or not
  const std::vector<float>& numbers(std::string_view field) const;
  const std::vector<int32_t>& integers(std::string_view field) const;
  const std::vector<std::string>& words(std::string_view field) const;
  float number(std::string_view field) const { return numbers(field)[0]; }
  int32_t integer(std::string_view field) const { return integers(field)[0]; }
  const std::string& word(std::string_view field) const { return words(field)[0]; }
  const InventorNode* node(std::string_view field) const;  ///< null when there is none
};

/// Diagnostics for whoever listens, each once, up to a limit.
class InventorWarnings {
 public:
  /// `file`: the one whose further warnings are said to be left out
  void add(const std::string& file, Diagnostic diagnostic);
  const std::vector<Diagnostic>& list() const { return list_; }

 private:
  std::vector<Diagnostic> list_;
  std::set<std::string> warned_;
};

struct InventorGraph {
  std::deque<InventorNode> nodes;
  const InventorNode* root = nullptr;
  std::deque<std::string> files;  ///< names, the first that of the file itself
  size_t bytes = 0;               ///< of all files, each counted once
  InventorWarnings warnings;      ///< of what is not used
  InventorWarnings repairs;       ///< of what was wrong and is read all the same

  /// For a sentence on a node: "box.iv:31", or "box.iv: part.iv:31" of one in an included file.
  Place place(const InventorNode& node) const;
};

/// Makes negative sizes positive and holds a complexity to 0..1; tells of these, of sizes and
/// factors of 0, of arrays without copies and of switches to a child that is not there.
void repair_values(InventorNode& node, InventorGraph& graph);

}  // namespace clench
