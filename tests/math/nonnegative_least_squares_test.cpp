#include "clench/math/nonnegative_least_squares.h"

#include <doctest/doctest.h>

#include <random>

#include "clench/math/decompositions.h"

using namespace clench;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// the least residual over all subsets of columns whose unconstrained solution is not negative
double min_residual_by_enumeration(const MatrixXd& a, const VectorXd& b) {
  double best = b.norm();
  for (int set = 1; set < 1 << a.cols(); ++set) {
    std::vector<int> columns;
    for (int i = 0; i < a.cols(); ++i)
      if (set >> i & 1) columns.push_back(i);
    const MatrixXd part = a(Eigen::all, columns);
    const Svd svd = singular_value_decomposition(part);
    if (svd.values.minCoeff() < 1e-9 || part.cols() > part.rows()) continue;
    const VectorXd x =
        svd.v * (svd.u.leftCols(svd.values.size()).transpose() * b).cwiseQuotient(svd.values);
    if (x.minCoeff() >= 0) best = std::min(best, (part * x - b).norm());
  }
  return best;
}

}  // namespace

TEST_CASE("the nearest point of a cone is that of the best subset of its columns") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int run = 0; run < 300; ++run) {
    const int rows = 1 + run % 5, columns = 1 + run % 9;
    MatrixXd a = MatrixXd::NullaryExpr(rows, columns, [&] { return number(random); });
    const VectorXd b = VectorXd::NullaryExpr(rows, [&] { return number(random); });
    // repeated columns, and columns of zeros
    if (columns > 3 && run % 3 == 0) a.col(1) = 2 * a.col(0), a.col(2).setZero();
    const VectorXd x = nonnegative_least_squares(a, b);
    CHECK(x.minCoeff() >= 0);
    const VectorXd rest = b - a * x;
    CHECK(rest.norm() == doctest::Approx(min_residual_by_enumeration(a, b)).epsilon(1e-9));
    // optimality: no column improves the fit, and the used columns are stationary
    const VectorXd slope = a.transpose() * rest;
    CHECK(slope.maxCoeff() < 1e-10);
    CHECK(std::abs(slope.dot(x)) < 1e-10);
  }
}

TEST_CASE("a point of the cone is its own nearest point, at any scale") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const MatrixXd a = MatrixXd::NullaryExpr(4, 20, [&] { return scale * number(random); });
    const VectorXd b = a * VectorXd::NullaryExpr(20, [&] { return std::abs(number(random)); });
    CHECK((a * nonnegative_least_squares(a, b) - b).norm() < 1e-10 * b.norm());
  }
}

TEST_CASE("columns that differ only by rounding are handled") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int run = 0; run < 200; ++run) {
    const int rows = 2 + run % 4;
    MatrixXd a(rows, 24);
    for (int i = 0; i < 24; ++i) {
      if (i % 6 == 0)
        a.col(i) = VectorXd::NullaryExpr(rows, [&] { return number(random); });
      else
        a.col(i) =
            a.col(i - 1) + 1e-14 * VectorXd::NullaryExpr(rows, [&] { return number(random); });
    }
    const VectorXd b = VectorXd::NullaryExpr(rows, [&] { return number(random); });
    const MatrixXd few = a(Eigen::all, std::vector<int>{0, 6, 12, 18});
    const VectorXd x = nonnegative_least_squares(a, b);
    CHECK(x.minCoeff() >= 0);
    CHECK((a * x - b).norm() == doctest::Approx(min_residual_by_enumeration(few, b)).epsilon(1e-9));
  }
}

TEST_CASE("no columns, and a right side of 0") {
  CHECK(nonnegative_least_squares(MatrixXd(3, 0), VectorXd::Ones(3)).size() == 0);
  CHECK(nonnegative_least_squares(MatrixXd::Ones(3, 2), VectorXd::Zero(3)).isZero(0));
}
