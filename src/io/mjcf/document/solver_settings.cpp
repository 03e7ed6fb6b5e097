#include "clench/io/mjcf/document/solver_settings.h"

#include <fmt/format.h>

#include "clench/base/text.h"
#include "clench/spec/valid.h"

namespace clench {

static bool has_value(const XmlElement& element, const char* name, const std::string& value) {
  return element.attribute(name).value_or("") == value;
}

std::string written_solref(double time_step) { return fmt::format("{} 1", 4 * time_step); }

/// The margin of an element with the stiffness of a written scene, if it represents a contact
/// threshold.
static std::optional<double> margin_of(const XmlElement& element, double time_step) {
  if (!has_value(element, "solimp", written_solimp) ||
      !has_value(element, "solref", written_solref(time_step)))
    return {};
  const auto margin = parse_number(element.attribute("margin").value_or(""));
  return margin && fault(contact_threshold_rule, *margin).empty() ? margin : std::nullopt;
}

bool is_written_setting(const XmlElement& element, const std::string& attribute, double time_step) {
  const std::string_view name = element.name();
  if (name == "option")
    return (attribute == "cone" && has_value(element, "cone", written_cone)) ||
           (attribute == "impratio" && has_value(element, "impratio", written_impratio)) ||
           (attribute == "integrator" && has_value(element, "integrator", written_integrator));
  if (name == "size")
    return attribute == "njmax" || attribute == "nconmax" || attribute == "nstack" ||
           attribute == "memory";
  if (name == "geom" || name == "pair")
    return (attribute == "margin" || attribute == "solref" || attribute == "solimp") &&
           margin_of(element, time_step);
  return false;
}

/// The last time step given by the document, 0 if none is a number [s].
static double time_step_of(const MjcfDocument& document) {
  double out = 0;
  for (const MjcfNode& node : document.root().children)
    if (node.name() == "option")
      if (const auto step = parse_number(node.element.attribute("timestep").value_or("")))
        out = *step;
  return out;
}

void accept_written_settings(MjcfDocument& document) {
  document.unused().accept(
      [step = time_step_of(document)](const XmlElement& element, const std::string& name) {
        return is_written_setting(element, name, step);
      });
}

std::optional<double> written_threshold(const MjcfDocument& document) {
  const double step = time_step_of(document);
  for (const MjcfNode& section : document.root().children)
    if (section.name() == "default")
      for (const MjcfNode& node : section.children)
        if (node.name() == "geom")
          if (const auto margin = margin_of(node.element, step)) return margin;
  return {};
}

}  // namespace clench
