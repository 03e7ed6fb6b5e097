#include "io/inertia.h"

#include "spec/inertia.h"

namespace clench {

Inertial repair_inertia(Eigen::Matrix3d& per_mass) {
  switch (inertia_fault(per_mass)) {
    case InertiaFault::none:
      return Inertial::sound;
    case InertiaFault::breaks_triangle:
      per_mass = with_triangle(per_mass);
      return Inertial::no_body;
    default:
      return Inertial::not_definite;
  }
}

std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows,
                                               const std::string& place,
                                               const Listeners& listeners) {
  if (rows != rows.transpose())
    tell(listeners.repair, listeners.warn,
         place + ": inertia_matrix is not symmetric; its symmetric part is used");
  Eigen::Matrix3d symmetric = 0.5 * (rows + rows.transpose());
  const Inertial fault = repair_inertia(symmetric);
  if (fault == Inertial::no_body)
    tell(listeners.repair, listeners.warn, place + ": " + raised_moments);
  if (fault != Inertial::not_definite) return symmetric;
  if (listeners.warn)
    listeners.warn(place +
                   ": inertia_matrix is not positive definite; it is computed from the shape");
  return {};
}

}  // namespace clench
