#include "clench/io/inventor/inventor_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clench {

namespace {

using K = InventorKind;

class ValueRepair {
 public:
  ValueRepair(InventorNode& node, InventorGraph& graph) : node_(node), graph_(graph) {}
  void repair();

 private:
  template <class... Args>
  void tell(std::string_view field, fmt::format_string<Args...> format, Args&&... args) {
    const std::string& file = graph_.files[node_.file];
    graph_.repairs.add(file, fmt::format("{}:{}: {}: {}: {}", file, node_.line, node_.type->name,
                                         field, fmt::format(format, std::forward<Args>(args)...)));
  }
  /// calls use(field, number) for each number that the node gives
  template <class Number, class Use>
  void each(Use use) {
    for (auto& [field, value] : node_.values)
      if (auto* numbers = std::get_if<std::vector<Number>>(&value))
        for (Number& x : *numbers) use(field->name, x);
  }
  void repair_sizes();
  void check_factors();
  void check_choice();

  InventorNode& node_;
  InventorGraph& graph_;
};

// all numbers of these shapes are lengths
void ValueRepair::repair_sizes() {
  each<float>([&](std::string_view field, float& x) {
    if (x == 0) tell(field, "0 leaves no volume");
    if (x < 0) tell(field, "{} is negative; {} is used", x, -x);
    x = std::abs(x);
  });
}

void ValueRepair::check_factors() {
  each<float>([&](std::string_view field, float x) {
    if (x == 0 && field.starts_with("scale") && field != "scaleOrientation")
      tell(field, "a factor of 0 makes flat what it scales");
  });
}

void ValueRepair::check_choice() {
  constexpr int none = -1, inherited = -2, all = -3;
  const auto count = static_cast<int>(node_.children.size());
  each<int32_t>([&](std::string_view field, int32_t choice) {
    if (choice != none && choice != inherited && choice != all && (choice < 0 || choice >= count))
      tell(field, "{} is none of {} children; none is used", choice, count);
  });
}

void ValueRepair::repair() {
  switch (node_.type->kind) {
    case K::cube:
    case K::sphere:
    case K::cylinder:
    case K::cone:
      return repair_sizes();
    case K::scale:
    case K::transform:
    case K::vrml_transform:
      return check_factors();
    case K::switching:
      return check_choice();
    case K::array:
      return each<int32_t>([&](std::string_view field, int32_t count) {
        if (count <= 0) tell(field, "{} makes no copies", count);
      });
    case K::complexity:
      return each<float>([&](std::string_view field, float& x) {
        const float bounded = std::clamp(x, 0.0f, 1.0f);
        if (x != bounded) tell(field, "{} is not in 0..1; {} is used", x, bounded);
        x = bounded;
      });
    default:
      return;
  }
}

}  // namespace

void repair_values(InventorNode& node, InventorGraph& graph) { ValueRepair(node, graph).repair(); }

}  // namespace clench
