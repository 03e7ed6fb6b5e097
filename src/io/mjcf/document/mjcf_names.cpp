#include "clench/io/mjcf/document/mjcf_names.h"

#include <algorithm>
#include <array>
#include <utility>

namespace clench {

std::string_view referred_kind(std::string_view attribute) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 23> kinds = {
      {{"joint", "joint"},        {"jointinparent", "joint"}, {"joint1", "joint"},
       {"joint2", "joint"},       {"tendon", "tendon"},       {"tendon1", "tendon"},
       {"tendon2", "tendon"},     {"body", "body"},           {"body1", "body"},
       {"body2", "body"},         {"geom", "geom"},           {"geom1", "geom"},
       {"geom2", "geom"},         {"site", "site"},           {"site1", "site"},
       {"site2", "site"},         {"sidesite", "site"},       {"refsite", "site"},
       {"cranksite", "site"},     {"slidersite", "site"},     {"actuator", "actuator"},
       {"actuator1", "actuator"}, {"actuator2", "actuator"}}};
  const auto found =
      std::ranges::find(kinds, attribute, &std::pair<std::string_view, std::string_view>::first);
  return found == kinds.end() ? std::string_view() : found->second;
}

/// Tendons and actuators share a name space over all their kinds of elements.
static std::string named_kind(const std::string& element) {
  if (element == "freejoint") return "joint";
  if (element == "fixed" || element == "spatial") return "tendon";
  return element;
}

void MjcfNames::add(const MjcfNode& node) {
  if (const std::string name = node.element.attribute("name").value_or(""); !name.empty())
    names_[named_kind(node.name())].insert(name);
  add(node.children);
}

void MjcfNames::add(const std::vector<MjcfNode>& nodes) {
  for (const MjcfNode& node : nodes) add(node);
}

bool MjcfNames::has(std::string_view kind, const std::string& name) const {
  const auto found = names_.find(kind);
  return found != names_.end() && found->second.contains(name);
}

void MjcfNames::add_referred(const MjcfNode& node) {
  for (const std::string& attribute : node.element.attributes())
    if (const std::string_view kind = referred_kind(attribute); !kind.empty())
      names_[std::string(kind)].insert(node.element.attribute(attribute).value_or(""));
  for (const MjcfNode& child : node.children) add_referred(child);
}

bool MjcfNames::overlaps(const MjcfNames& other) const {
  return std::ranges::any_of(names_, [&](const auto& entry) {
    return std::ranges::any_of(
        entry.second, [&](const std::string& name) { return other.has(entry.first, name); });
  });
}

MjcfNames::References MjcfNames::references(const MjcfNode& node) const {
  References out;
  for (const std::string& attribute : node.element.attributes()) {
    const std::string_view kind = referred_kind(attribute);
    if (kind.empty()) continue;
    ++(has(kind, node.element.attribute(attribute).value_or("")) ? out.inside : out.outside);
  }
  for (const MjcfNode& child : node.children) {
    const References below = references(child);
    out.inside += below.inside;
    out.outside += below.outside;
  }
  return out;
}

}  // namespace clench
