// What an inertia may be: one rule, the same for files, scripts, specs and worlds.
#pragma once
#include <Eigen/Core>
#include <string_view>

namespace clench {

enum class InertiaFault {
  none,
  not_symmetric,
  not_definite,     ///< or its moments are no numbers, or none of anything that fits into a world
  breaks_triangle,  ///< one moment exceeds the sum of the others, as no body's does
};

/// Of an inertia about the centre of mass, per mass [m^2].
InertiaFault inertia_fault(const Eigen::Matrix3d& per_mass);

/// throws Error  "body 'cup': inertia: expected no moment above the sum of the others, got one of 50
///         times that sum"
void check_inertia(const Eigen::Matrix3d& per_mass, std::string_view subject);

/// The same axes and the same largest moment; the others raised by the same until their sum is that.
/// `per_mass`  one that breaks the triangle
Eigen::Matrix3d with_triangle(const Eigen::Matrix3d& per_mass);

}  // namespace clench
