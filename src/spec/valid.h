// Valid range of each quantity of a model: one rule for files, scripts, specs and worlds.
#pragma once
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "clench/geometry/mesh/mesh.h"
#include "clench/math/pose.h"

namespace clench {

/// Beyond this, products of masses, lengths and forces may overflow.
inline constexpr double largest_number = 1e30;

/// Closed range of valid numbers. Infinity and NaN are outside of any range.
struct Quantity {
  const char* name;  ///< name of the quantity in sentences
  const char* unit;  ///< of the bounds; "": none
  double min, max;

  bool allows(double x) const { return x >= min && x <= max; }
  /// The same in another unit, as used by files.
  constexpr Quantity in(const char* other, double factor) const {
    return {name, other, min / factor, max / factor};
  }
  constexpr Quantity called(const char* other) const { return {other, unit, min, max}; }
};

// from a thousandth of a grain of dust to a mountain: inertias and weights stay far inside the
// range of doubles
inline constexpr Quantity mass_rule{"mass", "kg", 1e-12, 1e12};
inline constexpr Quantity density_rule{"density", "kg/m^3", 1e-12, 1e12};
inline constexpr Quantity coordinate_rule{"coordinates", "m", -largest_coordinate,
                                          largest_coordinate};
inline constexpr Quantity length_rule{"length", "m", 1e-12, largest_coordinate};
inline constexpr Quantity scale_rule{"scale", "", 1e-12, 1e12};
// at the bound the last bit of an angle corresponds to a ten millionth of a radian
inline constexpr Quantity angle_rule{"angle", "rad", -1e9, 1e9};
// a thousand times that of diamond: stiffer is rigid
inline constexpr Quantity elastic_modulus_rule{"elastic modulus", "Pa", 1e-3, 1e15};
inline constexpr Quantity soft_layer_rule{"soft layer", "m", 1e-9, largest_coordinate};
// at 0.5 a layer is incompressible and does not yield; a millionth below it does
inline constexpr Quantity poisson_ratio_rule{"Poisson's ratio", "", 0, 0.499999};
// a cone of this slope is a half space up to a fifth of a second of arc
inline constexpr Quantity friction_rule{"friction", "", 0, 1e6};
// above the rounding of a meter; beyond a centimeter complete fingers would be one contact
inline constexpr Quantity contact_threshold_rule{"contact threshold", "m", 1e-9, 0.01};
inline constexpr Quantity gravity_rule{"gravity", "m/s^2", -1e6, 1e6};
inline constexpr Quantity time_step_rule{"time step", "s", 1e-7, 1};
inline constexpr Quantity duration_rule{"time", "s", 0, 1e6};
inline constexpr Quantity velocity_rule{"velocity", "m/s or rad/s", -1e6, 1e6};
inline constexpr Quantity load_rule{"load", "N or N m", -1e15, 1e15};
inline constexpr Quantity restitution_rule{"restitution", "", 0, 1};
inline constexpr Quantity share_rule{"share", "", 0, 1};  ///< colors, transparency
/// of joints and DOFs; files use 1e16 and similar for infinity
inline constexpr Quantity limit_rule{"limit", "rad or m", -largest_number, largest_number};
inline constexpr Quantity number_rule{"number", "", -largest_number, largest_number};
inline constexpr Quantity positive_rule{"number", "", 1 / largest_number, largest_number};
inline constexpr Quantity not_negative_rule{"number", "", 0, largest_number};

/// "expected a number from 1e-12 to 1e+12 [kg], got 0"; empty if it is valid.
std::string fault(const Quantity& quantity, double x);

/// throws Error  "body 'cup': mass: expected a number from 1e-12 to 1e+12 [kg], got 0"
void check(const Quantity& quantity, double x, std::string_view subject);
/// Checks each of three.
void check(const Quantity& quantity, const Eigen::Vector3d& v, std::string_view subject);

struct NamedNumber {
  const char* name;
  double value;
};
/// Checks each under its own name.
void check_each(const Quantity& quantity, std::initializer_list<NamedNumber> numbers,
                std::string_view subject);

/// Checks that a position is within the bounds of coordinates, and a quaternion is unit.
bool is_place(const Pose& X);
/// throws Error  "robot 'arm': expected a position within 1e+09 m of the origin, got ..."
void check_place(const Pose& X, std::string_view subject);

// --- names ---

inline constexpr size_t max_name_length = 250;  ///< bytes, the limit of file systems

/// Reason why a text is not a valid name of a body, robot, link, DOF or material: it is longer than
/// max_name_length, has control characters or is not UTF-8; empty if it is valid.
std::string name_fault(std::string_view name);
/// throws Error  "world:add_object: name: expected no control characters, got 'a?b'"
void check_name(std::string_view name, std::string_view subject);
/// The name with '?' in place of each invalid byte, cut if it is too long.
std::string repaired_name(std::string_view name);

}  // namespace clench
