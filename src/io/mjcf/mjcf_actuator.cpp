#include "clench/io/mjcf/mjcf_actuator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clench {

namespace {

constexpr std::string_view shortcuts[] = {
    "general", "motor",    "position", "velocity", "intvelocity", "damper", "cylinder",
    "muscle",  "adhesion", "dcmotor",  "pid",      "orientation", "plugin"};

/// Parameters of an actuator, written by the elements of its class and then by its own.
struct Law {
  std::string dynamics = "none", gain_type = "fixed", bias_type = "none";
  double gain = 1;
  std::array<double, 3> bias = {0, 0, 0};
  double inherit_range = 0;
  bool other = false;  // kind of actuator that these parameters do not describe

  void read(const XmlElement& element, MjcfDocument& document);

 private:
  void read_general(const XmlValues& values);
  void read_servo(const XmlValues& values, MjcfDocument& document, bool integrated);
};

void Law::read_general(const XmlValues& values) {
  dynamics = values.text("dyntype", dynamics);
  gain_type = values.text("gaintype", gain_type);
  bias_type = values.text("biastype", bias_type);
  if (values.has("gainprm")) gain = values.numbers("gainprm", 1, 100)[0];
  if (!values.has("biasprm")) return;
  const auto given = values.numbers("biasprm", 1, 100);
  for (size_t i = 0; i < std::min(bias.size(), given.size()); ++i) bias[i] = given[i];
}

void Law::read_servo(const XmlValues& values, MjcfDocument& document, bool integrated) {
  gain = values.not_negative("kp", gain, document.repairs());
  bias[1] = -gain;
  if (values.has("kv")) bias[2] = -values.not_negative("kv", 0, document.repairs());
  if (values.has("dampratio")) {
    if (values.has("kv"))
      document.repairs().add("dampratio", values.subject("dampratio") +
                                              ": expected either kv or dampratio, got both; "
                                              "dampratio is used");
    // a positive number is a ratio
    bias[2] = values.not_negative("dampratio", 0, document.repairs());
  }
  if (values.has("timeconst"))
    dynamics = values.not_negative("timeconst", 0, document.repairs()) > 0 ? "filterexact" : "none";
  if (integrated) dynamics = "integrator";
  inherit_range = values.not_negative("inheritrange", inherit_range, document.repairs());
  gain_type = "fixed", bias_type = "affine";
}

void Law::read(const XmlElement& element, MjcfDocument& document) {
  const XmlValues values(element);
  const std::string_view kind = element.name();
  other = false;
  if (kind == "general") {
    read_general(values);
  } else if (kind == "motor") {
    gain = 1;
    dynamics = "none", gain_type = "fixed", bias_type = "none";
  } else if (kind == "position" || kind == "intvelocity") {
    read_servo(values, document, kind == "intvelocity");
  } else if (kind == "velocity") {
    gain = values.not_negative("kv", gain, document.repairs());
    bias = {0, 0, -gain};
    dynamics = "none", gain_type = "fixed", bias_type = "affine";
  } else {
    other = true;
  }
}

double largest_of(const std::array<double, 2>& range) {
  return std::max(std::abs(range[0]), std::abs(range[1]));
}

}  // namespace

std::optional<std::array<double, 2>> limited_range(const XmlValues& values, MjcfDocument& document,
                                                   const char* range, const char* limited_name) {
  if (!values.has(range)) return {};
  const std::string limited = values.word(limited_name, {"auto", "true", "false"}, "auto");
  if (limited == "false") return {};
  const auto both = values.range(range, document.repairs());
  if (limited == "auto" && both[0] == 0 && both[1] == 0) return {};
  if (limited == "auto" && !document.settings(values.element()).autolimits)
    document.repairs().add(
        "autolimits", fmt::format("{}: expected {}=\"true\" beside it, as autolimits is off; the "
                                  "range is used",
                                  values.subject(range), limited_name));
  return both;
}

double MjcfActuator::max_force() const {
  double force = std::numeric_limits<double>::infinity();
  if (spec.force_range) force = largest_of(*spec.force_range);
  const bool unbiased = spec.bias == std::array<double, 3>{0, 0, 0} && spec.damping_ratio == 0;
  if (spec.law_known && unbiased && spec.control_range)
    force = std::min(force, std::abs(spec.gain) * largest_of(*spec.control_range));
  if (spec.law_known && unbiased && spec.gain == 0) force = 0;
  return spec.gear == 0 ? 0 : force * std::abs(spec.gear);
}

MjcfActuator read_mjcf_actuator(MjcfDocument& document, const XmlElement& element) {
  const auto behind = document.defaults(element, "", shortcuts);
  MjcfActuator out;
  out.values = XmlValues(element, behind);
  const XmlValues& values = out.values;
  ActuatorSpec& spec = out.spec;
  spec.kind = element.name();
  spec.name = values.text("name", "");
  spec.joint = values.text("joint", values.text("jointinparent", ""));
  if (spec.joint.empty()) spec.tendon = values.text("tendon", "");
  if (values.has("gear")) spec.gear = values.numbers("gear", 1, 6)[0];
  spec.control_range = limited_range(values, document, "ctrlrange", "ctrllimited");
  spec.force_range = limited_range(values, document, "forcerange", "forcelimited");

  Law law;
  for (size_t i = behind.size(); i-- > 0;) law.read(behind[i], document);
  law.read(element, document);
  const bool filtered = law.dynamics == "filter" || law.dynamics == "filterexact";
  if (filtered) out.filter = law.dynamics;
  spec.law_known = !law.other && (law.bias_type == "none" || law.bias_type == "affine") &&
                   law.gain_type == "fixed" && (law.dynamics == "none" || filtered);
  if (!spec.law_known) return out;
  spec.gain = law.gain;
  if (law.bias_type == "affine") spec.bias = law.bias;
  out.holds_position = spec.gain > 0 && spec.bias[1] == -spec.gain;
  if (spec.bias[2] > 0 && spec.gain == -spec.bias[1])
    spec.damping_ratio = std::exchange(spec.bias[2], 0);
  out.inherit_range = law.inherit_range;
  return out;
}

}  // namespace clench
