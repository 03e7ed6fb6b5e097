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

/// Does one moment exceed the sum of the others, as no body's does? Files round: 1 % is passed over.
bool breaks_triangle(const Eigen::Matrix3d& inertia);

/// Tells of such an inertia, which is used as it stands; the sentence begins with `place`.
void doubt_inertia(const Eigen::Matrix3d& inertia, const std::string& place,
                   const Listeners& listeners);

}  // namespace clench
