// Factorizations and products that can be stopped: bit-identical to Eigen's own, with frequent
// checks.
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include "clench/base/random.h"
#include "clench/base/watched.h"
#include "clench/math/decompositions.h"
#include "clench/math/lcp.h"
#include "clench/math/product.h"
#include "clench/math/sparse_ldl.h"

using namespace clench;
using Eigen::MatrixXd, Eigen::VectorXd;

namespace {

MatrixXd random_entries(Random& random, int rows, int columns) {
  MatrixXd m(rows, columns);
  for (double& x : m.reshaped()) x = random.normal();
  return m;
}

// with a diagonal that makes it positive definite
MatrixXd random_symmetric(Random& random, int rows) {
  MatrixXd m = random_entries(random, rows, rows);
  m = (m + m.transpose()).eval();
  m.diagonal().array() += 4 * rows;
  return m;
}

}  // namespace

TEST_CASE("factorizations of large and small matrices are bit-identical to Eigen's own") {
  Random random(1);
  // below and above the size from which Clench divides into blocks, with complete and partial
  // blocks
  for (const int rows : {1, 2, 17, 40, 300, 512, 601}) {
    CAPTURE(rows);
    const MatrixXd m = random_entries(random, rows, rows), s = random_symmetric(random, rows);
    const VectorXd right = random_entries(random, rows, 1);
    DenseLu lu;
    lu.factor(m);
    CHECK(lu.solve(right) == VectorXd(Eigen::PartialPivLU<MatrixXd>(m).solve(right)));
    DenseCholesky cholesky;
    REQUIRE(cholesky.factor(s));
    CHECK(cholesky.solve(right) == VectorXd(Eigen::LLT<MatrixXd>(s).solve(right)));
    CHECK_FALSE(cholesky.factor(-s));
  }
}

TEST_CASE("a product in parts is bit-identical to the undivided one") {
  Random random(2);
  const MatrixXd a = random_entries(random, 1500, 4000);
  for (const int columns : {1, 3, 39, 45}) {
    CAPTURE(columns);
    const MatrixXd b = random_entries(random, 4000, columns);
    const Watched watched{Progress()};
    const MatrixXd parts = product(a, b);
    CHECK(parts == MatrixXd(a * b));
    CHECK(watched.checks() >= static_cast<uint64_t>(columns) / 40 + 1);
  }
}

TEST_CASE("a sparse factorization is bit-identical to Eigen's own") {
  Random random(3);
  for (const int rows : {1, 5, 60, 200}) {
    CAPTURE(rows);
    MatrixXd dense = random_symmetric(random, rows);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < i; ++j)
        if (random.uniform() < 0.9) dense(i, j) = 0;
    const SparseLdl::Matrix lower = MatrixXd(dense.triangularView<Eigen::Lower>()).sparseView();
    Eigen::SimplicialLDLT<SparseLdl::Matrix, Eigen::Lower> expected(lower);
    SparseLdl ldl(lower);
    const VectorXd right = random_entries(random, rows, 1);
    for (int again = 0; again < 2; ++again) {
      REQUIRE(ldl.factor(lower));
      CHECK(ldl.solve(right) == VectorXd(expected.solve(right)));
    }
  }
}

TEST_CASE("factorizations stop between their blocks, and the next one is unaffected") {
  Random random(4);
  const int rows = 600;
  const MatrixXd m = random_entries(random, rows, rows), s = random_symmetric(random, rows);
  const VectorXd right = random_entries(random, rows, 1);
  DenseLu lu(m);
  DenseCholesky cholesky;
  REQUIRE(cholesky.factor(s));
  const VectorXd by_lu = lu.solve(right), by_cholesky = cholesky.solve(right);
  for (const uint64_t check : {1, 4, 8}) {
    Watched watched{Progress()};
    watched.stop_at(check);
    CHECK_THROWS_AS(lu.factor(m), Stopped);
    watched.stop_at(watched.checks() + check);
    CHECK_THROWS_AS(cholesky.factor(s), Stopped);
  }
  lu.factor(m);
  CHECK(lu.solve(right) == by_lu);
  REQUIRE(cholesky.factor(s));
  CHECK(cholesky.solve(right) == by_cholesky);
}

TEST_CASE("a complementarity problem checks for stops at each pivot") {
  Random random(5);
  const int rows = 40;
  const MatrixXd M = random_symmetric(random, rows);
  const VectorXd q = random_entries(random, rows, 1);
  Watched watched{Progress()};
  const LcpSolution solution = solve_lcp(M, q);
  CHECK(solution.status == LcpStatus::solved);
  CHECK(watched.checks() >= static_cast<uint64_t>(solution.iterations));
  watched.stop_at(watched.checks() + 2);
  CHECK_THROWS_AS(solve_lcp(M, q), Stopped);
}
