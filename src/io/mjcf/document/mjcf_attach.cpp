#include "clench/io/mjcf/document/mjcf_attach.h"

#include "clench/io/mjcf/document/mjcf_names.h"

namespace clench {

namespace {

bool holds_targets(const MjcfNode& node) {
  const std::string name = node.name();
  return name == "body" || name == "frame" || name == "replicate";
}

void find_target(const MjcfNode& at, const std::string& kind, const std::string& name,
                 const std::string& child_class, AttachTarget& found, size_t& searched) {
  for (const MjcfNode& child : at.children) {
    if (found.node) return;
    ++searched;
    if (child.name() == kind && child.element.attribute("name").value_or("") == name) {
      found = {&child, child_class};
      return;
    }
    if (holds_targets(child))
      find_target(child, kind, name, child.element.attribute("childclass").value_or(child_class),
                  found, searched);
  }
}

void add_target_names(const MjcfNode& at, const std::string& kind,
                      std::vector<std::string>& names) {
  for (const MjcfNode& child : at.children) {
    const std::string own = child.element.attribute("name").value_or("");
    if (child.name() == kind && !own.empty()) names.push_back(own);
    if (holds_targets(child)) add_target_names(child, kind, names);
  }
}

}  // namespace

AttachTarget find_attach_target(const MjcfNode& model, const std::string& kind,
                                const std::string& name, size_t& searched) {
  AttachTarget found;
  for (const MjcfNode& section : model.children)
    if (section.name() == "worldbody") find_target(section, kind, name, "", found, searched);
  return found;
}

std::vector<std::string> attach_target_names(const MjcfNode& model, const std::string& kind) {
  std::vector<std::string> names;
  for (const MjcfNode& section : model.children)
    if (section.name() == "worldbody") add_target_names(section, kind, names);
  return names;
}

std::string AttachedNames::class_name(const std::string& name) const {
  return of_other_model ? prefix + (name.empty() ? "main" : name) : name;
}

std::string AttachedNames::operator()(const MjcfNode&, const std::string& attribute,
                                      const std::string& value) const {
  if (value.empty()) return value;
  if (attribute == "name" || !referred_kind(attribute).empty()) return prefix + value;
  const bool of_model = attribute == "class" || attribute == "childclass" ||
                        attribute == "material" || attribute == "mesh" || attribute == "hfield";
  return of_model && of_other_model ? prefix + value : value;
}

}  // namespace clench
