#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clench/io/inventor/inventor_nodes.h"

namespace clench {

namespace {

using K = InventorKind;

/// Reports the result of `fault` for each number of the node; `fault` may repair the number.
template <class Number, class Fault>
void tell_faults(InventorNode& node, InventorGraph& graph, Fault fault) {
  const std::string& file = graph.files[node.file];
  for (auto& [field, value] : node.values)
    if (auto* numbers = std::get_if<std::vector<Number>>(&value))
      for (Number& x : *numbers)
        if (const std::string wrong = fault(x, field->name); !wrong.empty())
          graph.repairs.add(file,
                            {Place(file, node.line).of(node.type->name).of(field->name), wrong});
}

// all numbers of cubes and similar shapes are lengths
std::string repair_size(float& x, std::string_view) {
  const float given = x;
  x = std::abs(x);
  if (x == 0) return "0 leaves no volume";
  return x == given ? "" : fmt::format("{} is negative; {} is used", given, x);
}

std::string repair_complexity(float& x, std::string_view) {
  const float given = x;
  x = std::clamp(x, 0.0f, 1.0f);
  return x == given ? "" : fmt::format("{} is not in 0..1; {} is used", given, x);
}

std::string factor_fault(float x, std::string_view field) {
  const bool factor = field.starts_with("scale") && field != "scaleOrientation";
  return factor && x == 0 ? "a factor of 0 flattens everything that it scales" : "";
}

std::string count_fault(int32_t count, std::string_view) {
  return count > 0 ? "" : fmt::format("{} makes no copies", count);
}

}  // namespace

void repair_values(InventorNode& node, InventorGraph& graph) {
  switch (node.type->kind) {
    case K::cube:
    case K::sphere:
    case K::cylinder:
    case K::cone:
      return tell_faults<float>(node, graph, repair_size);
    case K::scale:
    case K::transform:
    case K::vrml_transform:
      return tell_faults<float>(node, graph, factor_fault);
    case K::complexity:
      return tell_faults<float>(node, graph, repair_complexity);
    case K::array:
      return tell_faults<int32_t>(node, graph, count_fault);
    case K::switching:
      return tell_faults<int32_t>(node, graph, [&](int32_t choice, std::string_view) {
        // -1: none, -2: inherited, -3: all
        const auto count = static_cast<int32_t>(node.children.size());
        return choice >= -3 && choice < count
                   ? ""
                   : fmt::format("{} is not one of {} children; none is used", choice, count);
      });
    default:
      return;
  }
}

}  // namespace clench
