#include "clench/dynamics/solve/solve_friction.h"

#include "clench/dynamics/solve/friction_residual.h"

using namespace clench;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Eigen::Vector3d;
using Eigen::Vector4d;

static FrictionProblem one_contact(const MatrixXd& W, const VectorXd& q, double mu) {
  return {.W = W, .q = q, .blocks = {{.tangents = static_cast<int>(q.size()) - 1, .mu = mu}}};
}

static VectorXd impulses(const FrictionProblem& problem) {
  const FrictionSolution solution = solve_friction(problem, {});
  CHECK(solution.solved);
  CHECK(solution.residual == friction_residual(problem, solution.r));
  CHECK(solution.residual < 1e-14);
  CHECK((solution.u - (problem.W * solution.r + problem.q)).norm() == 0);
  return solution.r;
}

TEST_CASE("a body of 2 kg on the ground opens, sticks or slides against its velocity") {
  const MatrixXd W = MatrixXd::Identity(3, 3) / 2;
  CHECK(impulses(one_contact(W, Vector3d(0.1, 3, 4), 0.5)).norm() == 0);
  CHECK((impulses(one_contact(W, Vector3d(-1, 0.3, -0.3), 0.5)) - Vector3d(2, -0.6, 0.6)).norm() < 1e-15);
  CHECK((impulses(one_contact(W, Vector3d(-1, 3, 4), 0.5)) - Vector3d(2, -0.6, -0.8)).norm() < 1e-15);
  CHECK((impulses(one_contact(W, Vector3d(-1, 3, 4), 0)) - Vector3d(2, 0, 0)).norm() < 1e-15);
  CHECK((impulses(one_contact(W.topLeftCorner(1, 1), VectorXd::Constant(1, -1), 0)) - VectorXd::Constant(1, 2)).norm() < 1e-15);
}
