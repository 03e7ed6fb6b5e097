// What each quantity of a model may be: one rule, the same for files, scripts, specs and worlds.
#pragma once
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "clench/geometry/mesh/mesh.h"
#include "clench/math/pose.h"

namespace clench {

/// Beyond this, products of masses, lengths and forces are no numbers any more.
inline constexpr double largest_number = 1e30;

/// A number and its bounds, which belong to it. Infinity and what is no number lie outside of any.
struct Quantity {
  const char* name;  ///< in sentences
  const char* unit;  ///< of the bounds; "": it has none
  double min, max;

  bool allows(double x) const { return x >= min && x <= max; }
  /// The same, counted in another unit as files do.
  constexpr Quantity in(const char* other, double factor) const {
    return {name, other, min / factor, max / factor};
  }
  constexpr Quantity called(const char* other) const { return {other, unit, min, max}; }
};

// from a grain of dust's thousandth to a mountain: inertias and weights stay far inside of doubles
inline constexpr Quantity mass_rule{"mass", "kg", 1e-12, 1e12};
inline constexpr Quantity density_rule{"density", "kg/m^3", 1e-12, 1e12};
inline constexpr Quantity coordinate_rule{"coordinates", "m", -largest_coordinate,
                                          largest_coordinate};
inline constexpr Quantity length_rule{"length", "m", 1e-12, largest_coordinate};
inline constexpr Quantity scale_rule{"scale", "", 1e-12, 1e12};
// at the bound the last bit of an angle is worth a ten millionth of a radian
inline constexpr Quantity angle_rule{"angle", "rad", -1e9, 1e9};
// a thousand times diamond: stiffer is rigid
inline constexpr Quantity elastic_modulus_rule{"elastic modulus", "Pa", 1e-3, 1e15};
inline constexpr Quantity soft_layer_rule{"soft layer", "m", 1e-9, largest_coordinate};
// at 0.5 a layer keeps its volume and does not give way; a millionth below it does
inline constexpr Quantity poisson_ratio_rule{"Poisson's ratio", "", 0, 0.499999};
// a cone of this slope is a half space but for a fifth of a second of arc
inline constexpr Quantity friction_rule{"friction", "", 0, 1e6};
// above the rounding of a metre; beyond a centimetre whole fingers would be one contact
inline constexpr Quantity contact_threshold_rule{"contact threshold", "m", 1e-9, 0.01};
inline constexpr Quantity gravity_rule{"gravity", "m/s^2", -1e6, 1e6};
inline constexpr Quantity time_step_rule{"time step", "s", 1e-7, 1};
inline constexpr Quantity duration_rule{"time", "s", 0, 1e6};
inline constexpr Quantity velocity_rule{"velocity", "m/s or rad/s", -1e6, 1e6};
inline constexpr Quantity load_rule{"load", "N or N m", -1e15, 1e15};
inline constexpr Quantity restitution_rule{"restitution", "", 0, 1};
inline constexpr Quantity share_rule{"share", "", 0, 1};  ///< colours, transparency
/// of joints and DOFs; files write 1e16 and the like for none
inline constexpr Quantity limit_rule{"limit", "rad or m", -largest_number, largest_number};
inline constexpr Quantity number_rule{"number", "", -largest_number, largest_number};
inline constexpr Quantity positive_rule{"number", "", 1 / largest_number, largest_number};
inline constexpr Quantity not_negative_rule{"number", "", 0, largest_number};

/// "expected a number from 1e-12 to 1e+12 [kg], got 0"; empty when it is allowed.
std::string fault(const Quantity& quantity, double x);

/// throws Error  "body 'cup': mass: expected a number from 1e-12 to 1e+12 [kg], got 0"
void check(const Quantity& quantity, double x, std::string_view subject);
/// Each of three.
void check(const Quantity& quantity, const Eigen::Vector3d& v, std::string_view subject);

struct NamedNumber {
  const char* name;
  double value;
};
/// Each by its own name.
void check_each(const Quantity& quantity, std::initializer_list<NamedNumber> numbers,
                std::string_view subject);

/// A position within the bounds of coordinates, and a unit quaternion.
bool is_place(const Pose& X);
/// throws Error  "robot 'arm': expected a position within 1e+09 m of the origin, got (0, 0,
///               1e+308)"
void check_place(const Pose& X, std::string_view subject);

// --- names ---

inline constexpr size_t max_name_length = 250;  ///< bytes, as file systems have it

/// Why a text is no name of a body, robot, link, DOF or material: it is longer than
/// max_name_length, has control characters or is not UTF-8; empty when it is one.
std::string name_fault(std::string_view name);
/// throws Error  "world:add_object: name: expected no control characters, got 'a?b'"
void check_name(std::string_view name, std::string_view subject);
/// The name with '?' in place of each byte that a name may not have, cut where it is too long.
std::string repaired_name(std::string_view name);

}  // namespace clench
