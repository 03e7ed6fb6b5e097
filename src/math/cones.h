// Products of second-order cones {(t, u): |u| <= t} and the operations of an interior-point method
// on them. A cone of size 1 is the half line t >= 0.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

using ConeSizes = std::vector<int>;  ///< of the cones, in the order of their rows

/// (1, 0, ..) in each cone
Eigen::VectorXd cone_unit(const ConeSizes& cones);

/// Minimum of t - |u|: positive inside, negative outside. Infinite without cones.
double cone_margin(const ConeSizes& cones, const Eigen::VectorXd& v);

/// The longest step a for which v + a dv stays inside; infinite if every step does.
/// v  strictly inside
double longest_step(const ConeSizes& cones, const Eigen::VectorXd& v, const Eigen::VectorXd& dv);

/// Jordan product a o b = (a.b, a0 b1 + b0 a1), and its inverse: divide(a, a o b) = b.
Eigen::VectorXd cone_product(const ConeSizes& cones, const Eigen::VectorXd& a,
                             const Eigen::VectorXd& b);
Eigen::VectorXd cone_divide(const ConeSizes& cones, const Eigen::VectorXd& a,
                            const Eigen::VectorXd& product);

/// The symmetric W that maps z and s to the same point: W z = W^-1 s = lambda.
/// s, z    strictly inside
/// source  Nesterov & Todd (1997); Vandenberghe (2010), The CVXOPT linear and quadratic cone
///         program solvers
class NesterovTodd {
 public:
  /// W = 1
  explicit NesterovTodd(const ConeSizes& cones);
  NesterovTodd(const ConeSizes& cones, const Eigen::VectorXd& s, const Eigen::VectorXd& z);
  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;
  Eigen::VectorXd apply_inverse(const Eigen::VectorXd& v) const;
  /// the same for the cone that begins at row `start`; in and out have its size
  void apply_inverse(int cone, int start, const double* in, double* out) const;
  const Eigen::VectorXd& lambda() const { return lambda_; }

 private:
  void apply(int cone, int start, int power, const double* in, double* out) const;

  ConeSizes cones_;
  Eigen::VectorXd w_, lambda_;  // w: t^2 - |u|^2 = 1
  std::vector<double> eta_;     // one per cone
};

}  // namespace clench
