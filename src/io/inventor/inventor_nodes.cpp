#include "clench/io/inventor/inventor_nodes.h"

#include <fmt/format.h>

namespace clench {

static constexpr size_t max_inventor_warnings = 1000;

template <class T>
static const std::vector<T>& value_of(const InventorNode& node, std::string_view name) {
  for (const auto& [field, value] : node.values)
    if (field->name == name) return std::get<std::vector<T>>(value);
  return std::get<std::vector<T>>(node.type->field(name)->absent);
}

const std::vector<float>& InventorNode::numbers(std::string_view field) const {
  return value_of<float>(*this, field);
}
const std::vector<int32_t>& InventorNode::integers(std::string_view field) const {
  return value_of<int32_t>(*this, field);
}
const std::vector<std::string>& InventorNode::words(std::string_view field) const {
  return value_of<std::string>(*this, field);
}
const InventorNode* InventorNode::node(std::string_view field) const {
  const auto& nodes = value_of<const InventorNode*>(*this, field);
  return nodes.empty() ? nullptr : nodes[0];
}

Place InventorGraph::place(const InventorNode& node) const {
  const Place within(files[node.file], node.line);
  return node.file == 0 ? within : Place(files[0]).of(within.text());
}

void InventorWarnings::add(const std::string& file, Diagnostic diagnostic) {
  if (list_.size() > max_inventor_warnings || !warned_.insert(diagnostic.sentence()).second) return;
  if (list_.size() == max_inventor_warnings)
    diagnostic = {Place(file), "further warnings are left out"};
  list_.push_back(std::move(diagnostic));
}

}  // namespace clench
