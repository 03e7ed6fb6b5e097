#include "io/inertia.h"

#include "math/decompositions.h"

namespace clench {

/// All moments finite and > 0; 1e-12 of the largest is rounding.
static bool is_inertia(const Eigen::Matrix3d& symmetric) {
  if (!symmetric.allFinite()) return false;
  const Eigen::Vector3d moments = eigenvalues(symmetric);
  return moments[0] > 0 && moments[0] > 1e-12 * moments[2];
}

std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows,
                                               const std::string& place,
                                               const Listeners& listeners) {
  if (rows != rows.transpose())
    tell(listeners.mend, listeners.warn,
         place + ": inertia_matrix is not symmetric; its symmetric part is used");
  const Eigen::Matrix3d symmetric = 0.5 * (rows + rows.transpose());
  if (is_inertia(symmetric)) return symmetric;
  if (listeners.warn)
    listeners.warn(place +
                   ": inertia_matrix is not positive definite; it is computed from the shape");
  return {};
}

}  // namespace clench
