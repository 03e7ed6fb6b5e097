// Inertia matrices as files give them: per unit of mass, and not always those of a body.
#pragma once
#include <optional>
#include <string>

#include <Eigen/Core>

#include "base/listeners.h"

namespace clench {

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

/// The symmetric part of `rows` [m^2], repaired; empty when it is no inertia: the shape's is to be used.
/// They are told of all three, with `place` in front.
std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows,
                                               const std::string& place,
                                               const Listeners& listeners);

}  // namespace clench
