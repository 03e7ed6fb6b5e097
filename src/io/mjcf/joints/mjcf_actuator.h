// Actuators of MJCF with the defaults of their classes, as MuJoCo compiles them.
#pragma once
#include <array>
#include <optional>
#include <set>

#include "clench/io/mjcf/document/mjcf_document.h"

namespace clench {

struct MjcfActuator {
  XmlValues values;
  ActuatorSpec spec;  ///< `dof`, `pulls` and `length_at_0` are not set
  /// control range of a position servo, as a fraction of the range of its target; 0: not given
  double inherit_range = 0;
  std::string dynamics = "none";  ///< between control and force, which are not simulated
  int group = 0;
};

/// A range, such as "ctrlrange", if the attribute `limited_name` enables it. A range of two zeros
/// cancels that of the class, unless the attribute is "true".
std::optional<std::array<double, 2>> limited_range(const XmlValues& values, MjcfDocument& document,
                                                   const char* range, const char* limited_name);

/// Actuators disabled by <option>: all by <flag actuation="disable"/>, or those of some groups.
struct MjcfActuatorSwitches {
  bool all_off = false;
  std::set<int> groups_off;
  Place place;  ///< of the element that disables them; empty: none is disabled

  bool off(int group) const { return all_off || groups_off.contains(group); }
};
/// throws  Error for an invalid number or word
MjcfActuatorSwitches read_actuator_switches(const MjcfDocument& document);

/// All shortcuts of <general>, such as <motor> and <position>, set the same parameters: those of a
/// class, under any of these names, are the defaults of all actuators of the class.
/// source  MuJoCo 3: XML reference, "actuator", and mjs_setToPosition and related functions
/// throws  Error for an invalid number or word
MjcfActuator read_mjcf_actuator(MjcfDocument& document, const XmlElement& element);

}  // namespace clench
