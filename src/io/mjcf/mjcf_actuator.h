// Actuators of MJCF with the defaults of their classes, as MuJoCo compiles them.
#pragma once
#include <array>
#include <optional>

#include "clench/io/mjcf/mjcf_document.h"

namespace clench {

struct MjcfActuator {
  XmlValues values;
  ActuatorSpec spec;            ///< `dof` is not set
  bool holds_position = false;  ///< its control is the length that it holds
  /// control range of a position servo, as a fraction of the range of its target; 0: not given
  double inherit_range = 0;
  std::string filter;  ///< dynamics between control and force that are not simulated; empty: none

  /// Largest force, gear included; infinite where nothing bounds it [N or N m].
  double max_force() const;
};

/// A range, such as "ctrlrange", if the attribute `limited_name` enables it. A range of two zeros
/// cancels that of the class, unless the attribute is "true".
std::optional<std::array<double, 2>> limited_range(const XmlValues& values, MjcfDocument& document,
                                                   const char* range, const char* limited_name);

/// All shortcuts of <general>, such as <motor> and <position>, write into one set of parameters:
/// those of a class, whatever they are called there, are the defaults of any actuator of the class.
/// source  MuJoCo 3: XML reference, "actuator", and mjs_setToPosition and its siblings
/// throws  Error for an invalid number or word
MjcfActuator read_mjcf_actuator(MjcfDocument& document, const XmlElement& element);

}  // namespace clench
