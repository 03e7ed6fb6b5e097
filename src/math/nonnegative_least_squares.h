// Least squares with nonnegative unknowns: the nearest point of a cone spanned by columns.
#pragma once
#include <Eigen/Core>

namespace clench {

/// x >= 0 that minimizes |a x - b|, for a few dozen unknowns. Among several minimizers, one with
/// few nonzero unknowns.
/// tolerance  largest descent of the residual along an unknown at the end, relative to |b| times
///            the length of its column
/// source     Lawson & Hanson (1974), Solving least squares problems, ch. 23
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                          double tolerance = 1e-12);

}  // namespace clench
