// Friction assigned by a file to a surface, and the combined friction of two such surfaces.
#pragma once
#include <compare>
#include <string>

namespace clench {

/// Friction of one surface, as that of a geom in MuJoCo.
struct OwnFriction {
  double mu = 1;  ///< Coulomb coefficient, >= 0
  /// for two surfaces in contact, the coefficient of the higher priority is used
  int priority = 0;
  bool frictionless = false;  ///< as condim="1" of a geom

  auto operator<=>(const OwnFriction&) const = default;
};

/// Coefficient of a contact: that of the higher priority; of equal priorities the larger one, or 0
/// if both are frictionless.
/// source  MuJoCo documentation, "Contact parameters"
double combined(const OwnFriction& a, const OwnFriction& b);

/// Name of the material with this friction, as in "friction 0.8 priority 1".
std::string material_name(const OwnFriction& friction);

}  // namespace clench
