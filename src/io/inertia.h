// Inertia matrices as files give them: per unit of mass, and not always those of a body.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace clench {

/// The symmetric part of `rows` [m^2]; empty when no body has such an inertia: the shape's is to be
/// used. `warn` is told of both, with `place` in front; it may be empty.
std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows,
                                               const std::string& place,
                                               const std::function<void(const std::string&)>& warn);

}  // namespace clench
