// Validity of inertias: one rule for files, scripts, specs and worlds; and the repair of invalid
// ones.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "clench/base/diagnostic.h"

namespace clench {

enum class InertiaFault {
  none,
  not_symmetric,
  not_definite,     ///< or its moments are not finite, or outside the range of any body in a world
  breaks_triangle,  ///< one moment exceeds the sum of the others, which is impossible
};

/// For an inertia about the center of mass, per mass [m^2].
InertiaFault inertia_fault(const Eigen::Matrix3d& per_mass);

/// throws Error  "body 'cup': inertia: expected no moment above the sum of the others, got ..."
void check_inertia(const Eigen::Matrix3d& per_mass, std::string_view subject);

/// The same axes and the same largest moment; the others are raised equally until their sum equals
/// it.
/// `per_mass`  one that violates the triangle inequality
Eigen::Matrix3d with_triangle(const Eigen::Matrix3d& per_mass);

/// A reader's decision about an inertia: see inertia_fault.
enum class Inertial {
  sound,
  no_body,       ///< one moment exceeded the sum of the others, which were raised
  not_definite,  ///< not an inertia; computed from the shape
  not_given,     ///< computed from the shape, too
};

/// Converts a symmetric matrix to the inertia of a body, if possible [m^2].
Inertial repair_inertia(Eigen::Matrix3d& per_mass);

/// Warning for an inertia whose other moments were raised.
inline constexpr const char* raised_moments =
    "impossible inertia, as one moment exceeds the sum of the others; these are increased to equal "
    "it";

/// The symmetric part of `rows` [m^2], repaired; empty if it is not an inertia: that of the shape
/// is to be used. All three cases are reported, with `place` in front.
std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows, const Place& place,
                                               const Diagnostics& diagnostics);

}  // namespace clench
