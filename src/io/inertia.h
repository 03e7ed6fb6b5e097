// Inertia matrices as files give them: per unit of mass, and not always those of a body.
#pragma once
#include <optional>
#include <string>

#include <Eigen/Core>

#include "base/listeners.h"

namespace clench {

/// The symmetric part of `rows` [m^2]; empty when no body has such an inertia: the shape's is to be
/// used. They are told of both, with `place` in front.
std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows,
                                               const std::string& place,
                                               const Listeners& listeners);

}  // namespace clench
