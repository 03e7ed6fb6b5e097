// One contact solved with all other impulses known.
#pragma once
#include <Eigen/Core>

namespace clench {

/// Solves u = W r + q with Coulomb's law for the 1 + tangents rows of one contact. A sliding
/// contact has u_t = -lambda r_t with lambda > 0, so that (A + lambda) r_t = b with the normal
/// eliminated from A and b: one equation for lambda, |r_t| = mu r_n, which always has a root if the
/// contact neither opens nor sticks.
///
/// source  Bonnefon & Daviet (2011), Quartic formulation of Coulomb 3D frictional contact, for the
///         reduction
class ContactBlock {
 public:
  /// W   its diagonal block, symmetric and positive definite, its first row at `W`, rows `stride`
  ///     apart
  void set(double mu, int tangents, const double* W, int stride, double added_to_diagonal);
  /// r   1 + tangents rows, output
  void solve(const double* q, double* r) const;

 private:
  double excess(double lambda, double normal, const double* c, double* y, double& r_n) const;

  double mu_ = 0;
  int tangents_ = 0;
  double W_nn_ = 1;
  double W_tn_[3] = {}, a_[3] = {}, w_[3] = {};  // eigenvalues of A; V^T W_tn
  double V_[9] = {};                             // columns: eigenvectors of A
};

}  // namespace clench
