// Friction that a surface brings along from its file, and how that of two surfaces combines.
#pragma once
#include <compare>
#include <string>

namespace clench {

/// The friction of a geom of MuJoCo.
struct OwnFriction {
  double mu = 1;     ///< Coulomb coefficient, >= 0
  int priority = 0;  ///< of two in contact, the coefficient of the higher priority counts
  bool frictionless = false;

  auto operator<=>(const OwnFriction&) const = default;
};

/// Coefficient of a contact: that of the higher priority; of equal priorities the larger one, or 0
/// if both are frictionless.
/// source  MuJoCo documentation, "Contact parameters"
double combined(const OwnFriction& a, const OwnFriction& b);

/// Name of the material with this friction, as in "friction 0.8 priority 1".
std::string material_name(const OwnFriction& friction);

}  // namespace clench
