#include "clench/dynamics/solve/solve_friction.h"

#include "clench/dynamics/solve/friction_residual.h"
#include "dynamics/friction_problems.h"

using namespace clench;
using clench::test::solve_friction;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

static FrictionProblem one_contact(const MatrixXd& W, const VectorXd& q, double mu) {
  return {.W = W, .q = q, .blocks = {{.tangents = static_cast<int>(q.size()) - 1, .mu = mu}}};
}

static VectorXd impulses(const FrictionProblem& problem) {
  const FrictionSolution solution = solve_friction(problem, {});
  CHECK(solution.solved);
  CHECK(solution.residual == friction_residual(problem, solution.r));
  CHECK(solution.residual <= 1e-12 * problem.q.lpNorm<Eigen::Infinity>());
  CHECK((solution.u - (problem.W * solution.r + problem.q)).norm() == 0);
  return solution.r;
}

TEST_CASE("a body of 2 kg on the ground lifts off, sticks or slides according to its velocity") {
  const MatrixXd W = MatrixXd::Identity(3, 3) / 2;
  CHECK(impulses(one_contact(W, Vector3d(0.1, 3, 4), 0.5)).norm() == 0);
  CHECK((impulses(one_contact(W, Vector3d(-1, 0.3, -0.3), 0.5)) - Vector3d(2, -0.6, 0.6)).norm() <
        1e-15);
  CHECK((impulses(one_contact(W, Vector3d(-1, 3, 4), 0.5)) - Vector3d(2, -0.6, -0.8)).norm() <
        1e-15);
  CHECK((impulses(one_contact(W, Vector3d(-1, 3, 4), 0)) - Vector3d(2, 0, 0)).norm() < 1e-15);
  CHECK(impulses(one_contact(W.topLeftCorner(1, 1), VectorXd::Constant(1, -1), 0))[0] ==
        doctest::Approx(2));
}

TEST_CASE("torsion shares the cone with sliding") {
  // 2 kg, and a moment of inertia for which the torsion row is 1/2 as well
  const MatrixXd W = MatrixXd::Identity(4, 4) / 2;
  const Vector4d sticks(-1, 0.1, 0.1, -0.4), slides(-1, 0, 3, -4);
  CHECK((impulses(one_contact(W, sticks, 0.5)) - Vector4d(2, -0.2, -0.2, 0.8)).norm() < 1e-15);
  CHECK((impulses(one_contact(W, slides, 0.5)) - Vector4d(2, 0, -0.6, 0.8)).norm() < 1e-15);
}

TEST_CASE("a contact that sliding presses together, or lifts") {
  // as in Painlevé's paradox: an impulse along the surface moves the point towards it or away from
  // it
  for (const double coupling : {-1.9, -0.5, 0.5, 1.9}) {
    MatrixXd W = MatrixXd::Identity(3, 3);
    W(1, 1) = W(2, 2) = 4;
    W(0, 1) = W(1, 0) = coupling;
    for (const double mu : {0.1, 1.0, 3.0})
      for (const double slip : {-20.0, -1.0, 0.0, 1.0, 20.0}) {
        const VectorXd r = impulses(one_contact(W, Vector3d(-1, slip, 0.1), mu)),
                       u = W * r + Vector3d(-1, slip, 0.1);
        CHECK(r[0] > 0);
        CHECK(std::abs(u[0]) < 1e-11);
        const double friction = r.tail(2).norm(), speed = u.tail(2).norm();
        CHECK(friction <= mu * r[0] + 1e-11);
        // friction opposes the sliding, with the maximal force
        if (speed > 1e-6) CHECK(r.tail(2).dot(u.tail(2)) == doctest::Approx(-mu * r[0] * speed));
      }
  }
}

// a box of 1 kg on its four corners, 0.2 m wide, whose center is 0.1 m high
static FrictionProblem box(const Vector3d& velocity, double mu) {
  MatrixXd J(12, 6);
  FrictionProblem problem;
  for (int i = 0; i < 4; ++i) {
    const Vector3d at(i % 2 ? 0.1 : -0.1, i / 2 ? 0.1 : -0.1, -0.1);
    for (int k = 0; k < 3; ++k) {
      const Vector3d d = Vector3d::Unit((k + 2) % 3);
      J.row(3 * i + k) << d.transpose(), at.cross(d).transpose();
    }
    problem.blocks.push_back({.row = 3 * i, .tangents = 2, .mu = mu});
  }
  Eigen::Matrix<double, 6, 1> inverse;
  inverse << 1, 1, 1, 150, 150, 150;
  problem.W = J * inverse.asDiagonal() * J.transpose();
  problem.q = J.leftCols(3) * velocity;
  return problem;
}

TEST_CASE("the four corners of a box carry a quarter each, from any starting point") {
  const FrictionProblem problem = box({0, 0, -0.01}, 0.5);
  for (const double start : {0.0, 0.1, 7.0}) {
    VectorXd warm = VectorXd::Zero(12);
    warm[0] = warm[9] = start;
    const FrictionSolution solution = solve_friction(problem, warm);
    CHECK(solution.solved);
    CHECK(solution.residual < 1e-16);
    for (int i = 0; i < 4; ++i)
      CHECK((solution.r.segment(3 * i, 3) - Vector3d(0.0025, 0, 0)).norm() < 1e-10);
  }
}

TEST_CASE(
    "a box slides as a point does, and tips if its friction exceeds its ratio of width to height") {
  FrictionSolution solution = solve_friction(box({1, 0, -0.01}, 0.5), {});
  CHECK(solution.solved);
  double load = 0, friction = 0;
  for (int i = 0; i < 4; ++i) load += solution.r[3 * i], friction += solution.r[3 * i + 1];
  CHECK(load == doctest::Approx(0.01));
  CHECK(friction == doctest::Approx(-0.005));
  CHECK(solution.u[1] == doctest::Approx(0.995));
  solution = solve_friction(box({1, 0, -0.01}, 1.5), {});
  CHECK(solution.solved);
  // the two rear corners lift off
  CHECK(solution.r[0] == 0);
  CHECK(solution.u[0] > 0);
}

TEST_CASE("limits, motors and equations are solved together") {
  FrictionProblem problem{
      .W = MatrixXd::Identity(4, 4), .q = Vector4d(-3, 3, 5, -0.5), .blocks = {}};
  const double infinity = std::numeric_limits<double>::infinity();
  problem.blocks = {
      {.row = 0}, {.row = 1}, {.row = 2, .low = -2, .high = 2}, {.row = 3, .low = -infinity}};
  const FrictionSolution solution = solve_friction(problem, {});
  CHECK(solution.solved);
  CHECK((solution.r - Vector4d(3, 0, -2, 0.5)).norm() < 1e-15);
  CHECK((solution.u - Vector4d(0, 3, 3, 0)).norm() < 1e-15);
}

TEST_CASE("a warm start that is a solution is returned bit-exactly") {
  const FrictionProblem problem = box({0, 0, -0.01}, 0.5);
  VectorXd uneven = VectorXd::Zero(12);
  uneven[0] = uneven[9] = 0.005;  // two opposite corners carry all
  const FrictionSolution solution = solve_friction(problem, uneven);
  CHECK(solution.solved);
  CHECK(solution.iterations == 0);
  CHECK(solution.r == uneven);
  CHECK_FALSE(solution.fell_back);
}

TEST_CASE("contradictory limits are violated by half each, without large impulses") {
  MatrixXd W(2, 2);
  W << 1, -1, -1, 1;
  for (const auto& blocks : {std::vector<FrictionProblem::Block>{{.row = 0}, {.row = 1}},
                             std::vector<FrictionProblem::Block>{{.row = 0, .tangents = 0},
                                                                 {.row = 1, .tangents = 0}}}) {
    const FrictionSolution solution =
        solve_friction({.W = W, .q = Eigen::Vector2d(-1, -0.5), .blocks = blocks}, {});
    CHECK_FALSE(solution.solved);
    CHECK(solution.fell_back);
    CHECK(solution.u[0] == doctest::Approx(-0.75));
    CHECK(solution.u[1] == doctest::Approx(-0.75));
    CHECK(solution.residual == doctest::Approx(0.75));
    CHECK(solution.r.norm() < 1);
  }
}

TEST_CASE("a contact that no impulse moves gets no impulse, and is unsolved if it approaches") {
  FrictionProblem problem = one_contact(MatrixXd::Zero(3, 3), Vector3d(0.5, 1, 0), 0.5);
  CHECK(impulses(problem).norm() == 0);
  problem.q[0] = -0.5;
  const FrictionSolution solution = solve_friction(problem, {});
  CHECK_FALSE(solution.solved);
  CHECK(solution.r.norm() == 0);
  CHECK(solution.residual > 0.4);
}

TEST_CASE("an empty problem is solved, and invalid numbers are not") {
  const FrictionSolution none =
      solve_friction({.W = MatrixXd(0, 0), .q = VectorXd(0), .blocks = {}}, {});
  CHECK(none.solved);
  CHECK(none.r.size() == 0);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](const FrictionProblem& problem) {
    const FrictionSolution solution = solve_friction(problem, {});
    CHECK_FALSE(solution.solved);
    CHECK(solution.residual == infinity);
    CHECK(solution.r == VectorXd::Zero(problem.q.size()));
    CHECK(friction_residual(problem, solution.r) == infinity);
  };
  const auto good = [] { return one_contact(MatrixXd::Identity(3, 3), Vector3d(-1, 0, 0), 0.5); };
  for (const double bad : {nan, infinity}) {
    FrictionProblem q = good(), W = good(), mu = good();
    q.q[1] = W.W(2, 2) = mu.blocks[0].mu = bad;
    refused(q), refused(W), refused(mu);
  }
  FrictionProblem negative = good(), bounds = good();
  negative.blocks[0].mu = -1;
  bounds.blocks = {{.row = 0, .low = 1}, {.row = 1}, {.row = 2}};
  refused(negative), refused(bounds);
  // an invalid warm start is ignored
  CHECK(solve_friction(good(), Vector3d(nan, 0, 0)).r == solve_friction(good(), {}).r);
  CHECK(solve_friction(good(), VectorXd::Ones(2)).r == solve_friction(good(), {}).r);
}

TEST_CASE("a light body between heavy bodies is solved") {
  // ground, 1e-3 kg, 1e5 kg: one row per contact
  MatrixXd W(2, 2);
  W << 1e3, -1e3, -1e3, 1e3 + 1e-5;
  const Eigen::Vector2d q(-0.01, 0);
  const std::vector<FrictionProblem::Block> blocks = {{.row = 0, .tangents = 0},
                                                      {.row = 1, .tangents = 0}};
  const FrictionSolution solution = solve_friction({.W = W, .q = q, .blocks = blocks}, {});
  CHECK(solution.solved);
  CHECK(solution.r[0] == doctest::Approx(0.01 * (1e5 + 1e-3)));
  CHECK(solution.r[1] == doctest::Approx(0.01 * 1e5));
}

TEST_CASE("a pyramid limits friction to a polygon, which is smallest between its edges") {
  const MatrixXd W = MatrixXd::Identity(3, 3) / 2;
  const FrictionSolution along = solve_friction(one_contact(W, Vector3d(-1, 3, 0.1), 0.5), {},
                                                {.cone = FrictionCone::pyramid, .edges = 4});
  CHECK(along.solved);
  CHECK((along.r - Vector3d(2, -1, 0)).norm() < 1e-10);
  const FrictionSolution sticks = solve_friction(one_contact(W, Vector3d(-1, 0.3, -0.2), 0.5), {},
                                                 {.cone = FrictionCone::pyramid});
  CHECK((sticks.r - Vector3d(2, -0.6, 0.4)).norm() < 1e-10);
}
