#include "clench/math/lcp.h"

#include "clench/base/random.h"
#include "clench/math/decompositions.h"
#include "support/cases.h"

using namespace clench;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd any_matrix(Random& random, int rows, int columns) {
  MatrixXd m(rows, columns);
  for (double& x : m.reshaped()) x = random.normal();
  return m;
}

// distance of z from a solution
double fault(const MatrixXd& M, const VectorXd& q, const VectorXd& z) {
  const VectorXd w = M * z + q;
  return z.cwiseMin(w).cwiseAbs().maxCoeff();
}

// solutions of all complementary bases
std::vector<VectorXd> enumerate(const MatrixXd& M, const VectorXd& q) {
  const int n = static_cast<int>(q.size());
  std::vector<VectorXd> found;
  for (int set = 0; set < 1 << n; ++set) {
    // w_i = 0 in the set, z_i = 0 outside
    MatrixXd rows = MatrixXd::Identity(n, n);
    VectorXd right = VectorXd::Zero(n);
    for (int i = 0; i < n; ++i)
      if (set >> i & 1) rows.row(i) = M.row(i), right[i] = -q[i];
    const VectorXd z = DenseLu(rows).solve(right);
    if (z.allFinite() && fault(M, q, z) < 1e-9) found.push_back(z);
  }
  return found;
}

}  // namespace

TEST_CASE("a positive definite matrix gives the unique solution, which enumeration finds as well") {
  Random random(1);
  for (int i = 0; i < test::cases(400); ++i) {
    const int n = 1 + i % 7;
    const MatrixXd half = any_matrix(random, n, n), turned = any_matrix(random, n, n);
    const MatrixXd M =
        half * half.transpose() + 0.01 * MatrixXd::Identity(n, n) + turned - turned.transpose();
    const VectorXd q = any_matrix(random, n, 1);
    const auto all = enumerate(M, q);
    REQUIRE(all.size() == 1);
    const LcpSolution solution = solve_lcp(M, q);
    CHECK(solution.status == LcpStatus::solved);
    CHECK((solution.z - all[0]).norm() < 1e-8 * (1 + all[0].norm()));
    CHECK(fault(M, q, solution.z) < 1e-10 * (1 + all[0].norm()));
  }
}

TEST_CASE(
    "for any matrix, results are solutions, and for semidefinite ones a ray proves that there is "
    "no solution") {
  Random random(2);
  int solved = 0, rays = 0, empty = 0;
  for (int i = 0; i < test::cases(400); ++i) {
    const int n = 1 + i % 6;
    MatrixXd M = any_matrix(random, n, n);
    const bool semidefinite = i % 2 == 0;
    if (semidefinite) M = M.leftCols((n + 1) / 2) * M.leftCols((n + 1) / 2).transpose();
    const VectorXd q = any_matrix(random, n, 1);
    const LcpSolution solution = solve_lcp(M, q);
    REQUIRE(solution.status != LcpStatus::iteration_limit);
    if (solution.status == LcpStatus::solved) {
      ++solved;
      CHECK(fault(M, q, solution.z) < 1e-9 * (1 + solution.z.norm()));
    } else {
      ++rays;
      CHECK(solution.z.norm() == 0);
      if (semidefinite) {
        ++empty;
        CHECK(enumerate(M, q).empty());
      }
    }
  }
  // an eighth under the sanitizers
  const bool all = clench::test::cases(8) == 8;
  CHECK(solved > (all ? 100 : 10));
  CHECK(rays > (all ? 100 : 10));
  CHECK(empty > (all ? 20 : 0));
}

TEST_CASE("ties do not make the pivots cycle") {
  // rows that occur several times, and many equal numbers
  Random random(3);
  for (int i = 0; i < test::cases(200); ++i) {
    const int n = 12;
    MatrixXd half(n, 3);
    for (double& x : half.reshaped()) x = std::floor(random.uniform(-1.0, 2.0));
    const MatrixXd M = half * half.transpose();
    const VectorXd q = half * Eigen::Vector3d(std::floor(random.uniform(-2.0, 3.0)), 1, -1);
    const LcpSolution solution = solve_lcp(M, q);
    CHECK(solution.status == LcpStatus::solved);
    CHECK(fault(M, q, solution.z) < 1e-12);
    CHECK(solve_lcp(M, q).z == solution.z);
  }
}

TEST_CASE("problems without unknowns, with a trivial solution, and with too few pivots") {
  CHECK(solve_lcp(MatrixXd(0, 0), VectorXd(0)).status == LcpStatus::solved);
  const LcpSolution idle = solve_lcp(MatrixXd::Identity(2, 2), VectorXd::Ones(2));
  CHECK(idle.status == LcpStatus::solved);
  CHECK(idle.z.norm() == 0);
  CHECK(idle.iterations == 0);
  const Eigen::Vector3d q(-3, -2, -1);
  CHECK(solve_lcp(MatrixXd::Identity(3, 3), q, 1).status == LcpStatus::iteration_limit);
  CHECK(solve_lcp(MatrixXd::Identity(3, 3), q).z == -q);
}
