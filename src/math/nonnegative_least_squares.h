// Least squares with unknowns that may not be negative: the nearest point of a cone that columns
// span.
#pragma once
#include <Eigen/Core>

namespace clench {

/// x >= 0 of least |a x - b|, of a few dozen unknowns. Among several of the same residual, one with
/// few that are not 0.
/// tolerance  how steeply the residual may still fall along an unknown, of |b| times its column's
///            length
/// source     Lawson & Hanson (1974), Solving least squares problems, ch. 23
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                          double tolerance = 1e-12);

}  // namespace clench
