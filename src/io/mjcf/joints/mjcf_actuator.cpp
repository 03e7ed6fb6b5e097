#include "clench/io/mjcf/joints/mjcf_actuator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace clench {

namespace {

constexpr std::string_view shortcuts[] = {
    "general", "motor",    "position", "velocity", "intvelocity", "damper", "cylinder",
    "muscle",  "adhesion", "dcmotor",  "pid",      "orientation", "plugin"};

/// Parameters of an actuator, set by the elements of its class and then by its own element.
struct Law {
  std::string dynamics = "none", gain_type = "fixed", bias_type = "none";
  std::array<double, 9> gain = {1};
  std::array<double, 9> bias = {};
  double inherit_range = 0;
  bool other = false;  // kind of actuator that these parameters do not describe

  void read(const XmlElement& element, MjcfDocument& document);

 private:
  void read_general(const XmlValues& values);
  void read_servo(const XmlValues& values, MjcfDocument& document, bool integrated);
  void read_cylinder(const XmlValues& values, MjcfDocument& document);
  void read_muscle(const XmlValues& values);
};

/// The first numbers of a list.
void take(const XmlValues& values, const char* name, std::array<double, 9>& into) {
  if (!values.has(name)) return;
  const auto given = values.numbers(name, 1, 100);
  std::copy_n(given.begin(), std::min(into.size(), given.size()), into.begin());
}

void Law::read_general(const XmlValues& values) {
  dynamics = values.text("dyntype", dynamics);
  gain_type = values.text("gaintype", gain_type);
  bias_type = values.text("biastype", bias_type);
  take(values, "gainprm", gain);
  take(values, "biasprm", bias);
}

void Law::read_servo(const XmlValues& values, MjcfDocument& document, bool integrated) {
  gain[0] = values.not_negative("kp", gain[0], document.repairs());
  bias[1] = -gain[0];
  if (values.has("kv")) bias[2] = -values.not_negative("kv", 0, document.repairs());
  if (values.has("dampratio")) {
    if (values.has("kv"))
      document.repairs().add("dampratio", values.subject("dampratio"),
                             "expected either kv or dampratio, got both; "
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

/// Its control is a pressure, its gain the area of the piston.
void Law::read_cylinder(const XmlValues& values, MjcfDocument& document) {
  gain[0] = values.not_negative("area", gain[0], document.repairs());
  if (const double diameter = values.number("diameter", -1); diameter >= 0)
    gain[0] = std::numbers::pi / 4 * diameter * diameter;
  if (values.has("bias")) {
    const auto given = values.numbers("bias", 1, 3);
    std::ranges::copy(given, bias.begin());
  }
  dynamics = "filter", gain_type = "fixed", bias_type = "affine";
}

/// gain: range (2), force, scale, lmin, lmax, vmax, fpmax, fvmax
void Law::read_muscle(const XmlValues& values) {
  if (gain_type != "muscle") gain = {0.75, 1.05, -1, 200, 0.5, 1.6, 1.5, 1.3, 1.2};
  if (values.has("range")) {
    const auto range = values.numbers("range", 2, 2);
    gain[0] = range[0], gain[1] = range[1];
  }
  const char* names[] = {"force", "scale", "lmin", "lmax", "vmax", "fpmax", "fvmax"};
  for (size_t i = 0; i < std::size(names); ++i) gain[i + 2] = values.number(names[i], gain[i + 2]);
  bias = gain;
  dynamics = gain_type = bias_type = "muscle";
}

void Law::read(const XmlElement& element, MjcfDocument& document) {
  const XmlValues values(element);
  const std::string_view kind = element.name();
  other = false;
  if (kind == "general") {
    read_general(values);
  } else if (kind == "motor") {
    gain[0] = 1;
    dynamics = "none", gain_type = "fixed", bias_type = "none";
  } else if (kind == "position" || kind == "intvelocity") {
    read_servo(values, document, kind == "intvelocity");
  } else if (kind == "velocity") {
    gain[0] = values.not_negative("kv", gain[0], document.repairs());
    bias = {0, 0, -gain[0]};
    dynamics = "none", gain_type = "fixed", bias_type = "affine";
  } else if (kind == "damper") {
    gain = {0, 0,
            -values.not_negative("kv", gain_type == "affine" ? -gain[2] : 1, document.repairs())};
    dynamics = "none", gain_type = "affine", bias_type = "none";
  } else if (kind == "cylinder") {
    read_cylinder(values, document);
  } else if (kind == "muscle") {
    read_muscle(values);
  } else {
    other = true;
  }
}

/// Range of the force of a muscle: from the largest active force at rest, plus the passive force at
/// its largest length, to 0. Its length, and the peak force if force < 0, are not known here.
/// source  MuJoCo: Modeling, "Muscle actuators": FL <= 1, FP rises beyond the optimal length
std::array<double, 2> muscle_range(const std::array<double, 9>& prm, double activation) {
  const double peak = prm[2];
  if (peak < 0) return {-std::numeric_limits<double>::infinity(), 0};
  const double top = prm[1], lmax = prm[5], fpmax = prm[7];
  const double middle = 0.5 * (1 + lmax), width = std::max(1e-15, middle - 1);
  const double rise = std::max(0.0, (top - 1) / width);
  const double passive = fpmax * (rise <= 1 ? 0.5 * rise * rise : rise - 0.5);
  return {-peak * (activation + std::max(0.0, passive)), 0};
}

/// The range of an activation: of a filter, its steady states; of an integrator, the values that it
/// reaches from 0 with its control, which may be one-sided.
std::array<double, 2> activations(const std::string& dynamics,
                                  const std::optional<std::array<double, 2>>& control,
                                  const std::optional<std::array<double, 2>>& limits) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<double, 2> range = control.value_or(std::array{-far, far});
  if (dynamics == "integrator") range = {range[0] < 0 ? -far : 0, range[1] > 0 ? far : 0};
  if (limits)
    for (double& x : range) x = std::clamp(x, (*limits)[0], (*limits)[1]);
  return range;
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
    document.repairs().add("autolimits", values.subject(range),
                           "expected {}=\"true\" with it, as autolimits is off; the range is used",
                           limited_name);
  return both;
}

MjcfActuatorSwitches read_actuator_switches(const MjcfDocument& document) {
  MjcfActuatorSwitches out;
  for (const MjcfNode& node : document.root().children) {
    if (node.name() != "option") continue;
    const XmlValues values(node.element);
    if (values.has("actuatorgroupdisable")) {
      out.groups_off.clear();
      for (const double group : values.numbers("actuatorgroupdisable", 0, 31)) {
        if (!(group >= 0 && group <= 30 && group == std::floor(group)))
          values.fail("actuatorgroupdisable", "expected integers from 0 to 30, got {}", group);
        out.groups_off.insert(static_cast<int>(group));
      }
      if (!out.groups_off.empty()) out.place = node.element.place();
    }
    for (const MjcfNode& child : node.children) {
      if (child.name() != "flag") continue;
      const XmlValues flags(child.element);
      if (!flags.has("actuation")) continue;
      out.all_off = flags.word("actuation", {"enable", "disable"}, "enable") == "disable";
      if (out.all_off) out.place = child.element.place();
    }
  }
  return out;
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
  out.group = values.integer("group", 0);
  spec.control_range = limited_range(values, document, "ctrlrange", "ctrllimited");
  spec.force_range = limited_range(values, document, "forcerange", "forcelimited");
  const auto act_range = limited_range(values, document, "actrange", "actlimited");

  Law law;
  for (size_t i = behind.size(); i-- > 0;) law.read(behind[i], document);
  law.read(element, document);
  const bool filtered = law.dynamics == "filter" || law.dynamics == "filterexact";
  const bool integrated = law.dynamics == "integrator";
  out.dynamics = law.dynamics;
  spec.law_known = !law.other && (law.bias_type == "none" || law.bias_type == "affine") &&
                   (law.gain_type == "fixed" || law.gain_type == "affine") &&
                   (law.dynamics == "none" || filtered || integrated);
  if (!law.other && law.gain_type == "muscle" && law.bias_type == "muscle") {
    const auto controls = spec.control_range.value_or(std::array{0.0, 1.0});
    const double activation = law.dynamics == "muscle" ? std::clamp(controls[1], 0.0, 1.0) : 1;
    spec.law_range = muscle_range(law.gain, activation);
  }
  if (!spec.law_known) return out;
  if (integrated || (filtered && act_range))
    spec.activation_range = activations(law.dynamics, spec.control_range, act_range);
  spec.gain = law.gain[0];
  if (law.gain_type == "affine") spec.gain_slopes = {law.gain[1], law.gain[2]};
  if (law.bias_type == "affine") std::copy_n(law.bias.begin(), 3, spec.bias.begin());
  if (spec.bias[2] > 0 && spec.gain == -spec.bias[1])
    spec.damping_ratio = std::exchange(spec.bias[2], 0);
  out.inherit_range = law.inherit_range;
  return out;
}

}  // namespace clench
