#include "clench/math/decompositions.h"

#include "clench/base/random.h"
#include "clench/math/sparse_ldl.h"

using namespace clench;
using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector3d;

static MatrixXd random_matrix(Random& random, int rows, int columns) {
  MatrixXd m(rows, columns);
  for (double& x : m.reshaped()) x = random.normal();
  return m;
}

// sums of some ten products of numbers of order 1
static constexpr double rounding = 1e-13;

TEST_CASE("the shortest rotation maps one direction to the other, about an axis normal to both") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d from = random_matrix(random, 3, 1), to = random_matrix(random, 3, 1);
    const auto turn = shortest_rotation(from, to);
    CHECK((turn * from.normalized() - to.normalized()).norm() < rounding);
    CHECK(std::abs(turn.vec().dot(from.normalized())) < rounding);
    CHECK(std::abs(turn.norm() - 1) < rounding);
    CHECK(turn.w() >= 0);
  }
}

TEST_CASE("the shortest rotation is correct for equal, opposite and nearly opposite directions") {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vector3d from = random_matrix(random, 3, 1);
    CHECK((shortest_rotation(from, 3 * from) * from - from).norm() < rounding);
    CHECK((shortest_rotation(from, -from) * from + from).norm() < rounding);
    for (const double off : {1e-3, 1e-5, 1e-7, 1e-9}) {
      const Vector3d to = -from.normalized() + off * random_matrix(random, 3, 1);
      // cancellation in the sum of opposite directions: rounding divided by their distance of at
      // least 1e-8
      CHECK((shortest_rotation(from, to) * from.normalized() - to.normalized()).norm() < 1e-7);
      CHECK(std::abs(shortest_rotation(from, to).norm() - 1) < 1e-7);
    }
  }
}

TEST_CASE("the product of the factors of a decomposition is the original matrix") {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const int rows = 1 + i % 7, columns = 1 + i / 7 % 7;
    const MatrixXd m = random_matrix(random, rows, columns);
    const Svd svd = singular_value_decomposition(m);
    const auto least = svd.values.size();
    const MatrixXd again = svd.u.leftCols(least) * svd.values.asDiagonal() * svd.v.transpose();
    CHECK((again - m).cwiseAbs().maxCoeff() < rounding);
    CHECK((svd.u.transpose() * svd.u - MatrixXd::Identity(rows, rows)).cwiseAbs().maxCoeff() <
          rounding);
    for (int k = 1; k < least; ++k) CHECK(svd.values[k - 1] >= svd.values[k]);

    const MatrixXd even = m * m.transpose();
    const auto system = eigensystem(even);
    CHECK((system.vectors * system.values.asDiagonal() * system.vectors.transpose() - even)
              .cwiseAbs()
              .maxCoeff() < 10 * rounding);  // its numbers are of order 10
    for (int k = 1; k < rows; ++k) CHECK(system.values[k - 1] <= system.values[k]);
  }
}

TEST_CASE("eigenvalues of small matrices and solutions satisfy their definitions") {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d a = random_matrix(random, 3, 3), even = a * a.transpose();
    const Vector3d values = eigenvalues(even);
    CHECK((eigensystem(even).values - values).norm() < 10 * rounding);
    for (const double value : values)
      CHECK(std::abs((even - value * Matrix3d::Identity()).determinant()) < 1e-10);  // of order 1e3
    const MatrixXd right = random_matrix(random, 3, 2);
    const MatrixXd m = even + Matrix3d::Identity();
    CHECK((m * solve_symmetric(m, right) - right).cwiseAbs().maxCoeff() < 10 * rounding);
  }
}

TEST_CASE("dependent rows are reported with their weights") {
  Random random(5);
  for (int i = 0; i < 30; ++i) {
    const int rank = 1 + i % 4, count = rank + i % 3;
    const MatrixXd mix = random_matrix(random, count, rank),
                   m = mix * random_matrix(random, rank, 6);
    const IndependentRows rows = independent_rows(m, 1e-10);
    REQUIRE(static_cast<int>(rows.rows.size()) == rank);
    REQUIRE(static_cast<int>(rows.others.size()) == count - rank);
    for (size_t k = 0; k < rows.others.size(); ++k) {
      Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(6);
      for (int r = 0; r < rank; ++r)
        sum += rows.weights(static_cast<int>(k), r) * m.row(rows.rows[r]);
      CHECK((sum - m.row(rows.others[k])).norm() < 1e-10);  // for condition numbers up to 1e3
    }
  }
  CHECK(independent_rows(MatrixXd::Zero(3, 2), 1e-10).rows.empty());
  CHECK(independent_rows(MatrixXd::Zero(3, 0), 1e-10).others.size() == 3);
  CHECK(independent_rows(MatrixXd::Zero(0, 4), 1e-10).others.empty());
}

TEST_CASE("sparse and dense factorizations solve systems of their matrix") {
  Random random(6);
  DenseLu lu;  // each factorizes one matrix after another, of different sizes
  DenseCholesky cholesky;
  for (int i = 0; i < 30; ++i) {
    // positive definite, negative definite, and indefinite
    const int n = 3 + i % 5, k = 1 + i % 3;
    MatrixXd m = MatrixXd::Zero(n + k, n + k);
    const MatrixXd half = random_matrix(random, n, n);
    m.topLeftCorner(n, n) = half * half.transpose() + MatrixXd::Identity(n, n);
    m.bottomRightCorner(k, k) = -MatrixXd::Identity(k, k);
    m.bottomLeftCorner(k, n) = random_matrix(random, k, n);
    m.topRightCorner(n, k) = m.bottomLeftCorner(k, n).transpose();
    const Eigen::VectorXd right = random_matrix(random, n + k, 1);
    const SparseLdl::Matrix sparse = m.sparseView();
    const SparseLdl::Matrix lower = sparse.triangularView<Eigen::Lower>();
    SparseLdl ldl(lower);
    REQUIRE(ldl.factor(lower));
    CHECK((m * ldl.solve(right) - right).norm() < 1e-11);  // for condition numbers up to 100
    lu.factor(m);
    CHECK((m * lu.solve(right) - right).norm() < 1e-11);
    CHECK_FALSE(cholesky.factor(m));
    REQUIRE(cholesky.factor(m.topLeftCorner(n, n)));
    const Eigen::VectorXd x = cholesky.solve(right.head(n));
    CHECK((m.topLeftCorner(n, n) * x - right.head(n)).norm() < 1e-11);
  }
  SparseLdl::Matrix zero(2, 2);
  zero.insert(0, 0) = 0;
  zero.insert(1, 1) = 0;
  CHECK_FALSE(SparseLdl(zero).factor(zero));
}
