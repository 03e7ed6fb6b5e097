#include "clench/math/block_lu.h"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "clench/base/random.h"

using namespace clench;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A matrix of random blocks whose symmetric part is positive definite.
struct BlockMatrix {
  std::vector<int> sizes;
  std::vector<std::pair<int, int>> pairs;
  MatrixXd dense;
  std::vector<int> first = {0};

  BlockMatrix(Random& random, int groups, bool all_six) {
    const auto below = [&](int count) { return static_cast<int>(random.uniform() * count); };
    for (int i = 0; i < groups; ++i) {
      sizes.push_back(all_six ? 6 : 1 + below(8));
      first.push_back(first.back() + sizes.back());
    }
    for (int k = 0; k < 2 * groups; ++k)
      if (const int i = below(groups), j = below(groups); i != j) pairs.emplace_back(i, j);
    // the symmetric part must be positive definite, because pivots are chosen within blocks only
    dense = MatrixXd::Zero(first.back(), first.back());
    for (const auto& [i, j] : pairs) {
      fill(random, i, j), fill(random, j, i);
    }
    for (int i = 0; i < groups; ++i) fill(random, i, i);
    const MatrixXd symmetric = 0.5 * (dense + dense.transpose());
    for (int k = 0; k < first.back(); ++k) dense(k, k) += 0.1 + symmetric.row(k).cwiseAbs().sum();
  }
  void fill(Random& random, int i, int j) {
    for (int r = first[i]; r < first[i + 1]; ++r)
      for (int c = first[j]; c < first[j + 1]; ++c) dense(r, c) = random.uniform(-1, 1);
  }
  void put(BlockLu& lu, int i, int j) const {
    Eigen::Map<MatrixXd>(lu.values() + lu.place(i, j), sizes[i], sizes[j]) =
        dense.block(first[i], first[j], sizes[i], sizes[j]);
  }
  bool factor(BlockLu& lu) const {
    lu.analyze(sizes, pairs);
    lu.set_zero();
    for (int i = 0; i < static_cast<int>(sizes.size()); ++i) put(lu, i, i);
    for (const auto& [i, j] : pairs) put(lu, i, j), put(lu, j, i);
    return lu.factor();
  }
};

}  // namespace

TEST_CASE("block LU gives the solutions of dense LU") {
  for (int number = 0; number < 60; ++number) {
    Random random(41, number);
    const BlockMatrix matrix(random, 1 + number % 30, number % 2 == 0);
    BlockLu lu;
    REQUIRE(matrix.factor(lu));
    VectorXd right(matrix.dense.rows());
    for (double& x : right) x = random.normal();
    VectorXd x = right;
    lu.solve(x);
    CHECK((matrix.dense * x - right).norm() <= 1e-12 * right.norm());
    const VectorXd other = matrix.dense.partialPivLu().solve(right);
    CHECK((x - other).norm() <= 1e-10 * other.norm());
  }
}

TEST_CASE("a singular block is reported") {
  BlockLu lu;
  lu.analyze({2, 3}, {{0, 1}});
  lu.set_zero();
  Eigen::Map<MatrixXd>(lu.values() + lu.place(0, 0), 2, 2).setIdentity();
  CHECK_FALSE(lu.factor());
}
