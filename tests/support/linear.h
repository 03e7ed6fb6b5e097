// Linear algebra of the tests, compiled once.
#pragma once
#include <Eigen/Core>
#include <optional>

#include "clench/base/random.h"

namespace clench::test {

/// A random orthonormal matrix of d rows.
Eigen::MatrixXd random_turn(int d, Random& random);

/// The unit vector perpendicular to all rows of m; empty unless it is unique up to its sign.
std::optional<Eigen::VectorXd> common_normal(const Eigen::MatrixXd& m);

/// All x of m x = right, as kernel * y + start. m has more columns than rows, which are
/// independent.
struct Solutions {
  Eigen::MatrixXd kernel;
  Eigen::VectorXd start;
};
Solutions solutions(const Eigen::MatrixXd& m, const Eigen::VectorXd& right);

double determinant(const Eigen::MatrixXd& m);

}  // namespace clench::test
