#include "io/inertia.h"

#include "math/decompositions.h"

namespace clench {

/// All moments finite and > 0; 1e-12 of the largest is rounding.
static bool is_inertia(const Eigen::Matrix3d& symmetric) {
  if (!symmetric.allFinite()) return false;
  const Eigen::Vector3d moments = eigenvalues(symmetric);
  return moments[0] > 0 && moments[0] > 1e-12 * moments[2];
}

bool breaks_triangle(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d moments = eigenvalues(inertia);
  return moments[2] > 1.01 * (moments[0] + moments[1]);
}

void doubt_inertia(const Eigen::Matrix3d& inertia, const std::string& place,
                   const Listeners& listeners) {
  if (breaks_triangle(inertia))
    tell(listeners.doubt, listeners.warn,
         place +
             ": inertia that no body has, as one moment exceeds the sum of the others; it is "
             "used as it stands");
}

std::optional<Eigen::Matrix3d> checked_inertia(const Eigen::Matrix3d& rows,
                                               const std::string& place,
                                               const Listeners& listeners) {
  if (rows != rows.transpose())
    tell(listeners.mend, listeners.warn,
         place + ": inertia_matrix is not symmetric; its symmetric part is used");
  const Eigen::Matrix3d symmetric = 0.5 * (rows + rows.transpose());
  if (is_inertia(symmetric)) {
    doubt_inertia(symmetric, place, listeners);
    return symmetric;
  }
  if (listeners.warn)
    listeners.warn(place +
                   ": inertia_matrix is not positive definite; it is computed from the shape");
  return {};
}

}  // namespace clench
