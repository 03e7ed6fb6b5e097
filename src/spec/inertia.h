// What an inertia may be: one rule, the same for files, scripts, specs and worlds; and what is made
// of one that may not.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "clench/base/listeners.h"

namespace clench {

enum class InertiaFault {
  none,
  not_symmetric,
  not_definite,     ///< or its moments are no numbers, or none of anything that fits into a world
  breaks_triangle,  ///< one moment exceeds the sum of the others, as no body's does
};

/// Of an inertia about the centre of mass, per mass [m^2].
InertiaFault inertia_fault(const Eigen::Matrix3d& per_mass);

/// throws Error  "body 'cup': inertia: expected no moment above the sum of the others, got one of
///               50
///         times that sum"
void check_inertia(const Eigen::Matrix3d& per_mass, std::string_view subject);

/// The same axes and the same largest moment; the others raised by the same until their sum is
/// that.
/// `per_mass`  one that breaks the triangle
Eigen::Matrix3d with_triangle(const Eigen::Matrix3d& per_mass);

/// What a reader does about an inertia: see inertia_fault.
enum class Inertial {
  sound,
  no_body,       ///< one moment exceeded the sum of the others, which were raised
  not_definite,  ///< no inertia; left to the shape
  not_given,     ///< left to the shape, too
};

/// Makes a symmetric matrix the inertia of a body where that can be [m^2].
Inertial repair_inertia(Eigen::Matrix3d& per_mass);

/// What is told of an inertia whose other moments were raised.
inline constexpr const char* raised_moments =
    "inertia that no body has, as one moment exceeds the sum of the others; these are raised to it";

/// The symmetric part of `rows` [m^2], repaired; empty when it is no inertia: the shape's is to be
/// used. They are told of all three, with `place` in front.
std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows,
                                               const std::string& place,
                                               const Listeners& listeners);

}  // namespace clench
