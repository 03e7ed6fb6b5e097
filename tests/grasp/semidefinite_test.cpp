// Least contact forces as a semidefinite program, solved by DSDP: another formulation, another
// method (dual scaling) and an independent implementation.
#include <doctest/doctest.h>
#include <dsdp/dsdp5.h>

#include <array>
#include <deque>

#include "clench/grasp/force/contact_forces.h"
#include "grasp/held_object.h"
#include "support/linear.h"

using namespace clench;
using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using test::wrench;

namespace {

// max b'y such that each block C - sum of A_i y_i is positive semidefinite
class SemidefiniteProgram {
 public:
  SemidefiniteProgram(int unknowns, int blocks) : unknowns_(unknowns) {
    REQUIRE(DSDPCreate(unknowns, &solver_) == 0);
    REQUIRE(DSDPCreateSDPCone(solver_, blocks, &cone_) == 0);
  }
  ~SemidefiniteProgram() { DSDPDestroy(solver_); }

  // t(y) >= |v(y)|, both affine, one row (slope, constant) each: the arrow matrix with t on its
  // diagonal and v in the last row
  void arrow(const Eigen::RowVectorXd& t, const MatrixXd& v) {
    const int size = static_cast<int>(v.rows()) + 1;
    SDPConeSetBlockSize(cone_, block_, size);
    for (int i = 0; i <= unknowns_; ++i) {
      // the constant is variable 0, and slopes are -A_i; packed lower triangle, row by row
      const Index column = i == 0 ? unknowns_ : i - 1;
      const double sign = i == 0 ? 1 : -1;
      auto& places = places_.emplace_back();
      auto& values = values_.emplace_back();
      for (int row = 0; row < size; ++row) {
        for (int k = 0; k < row; ++k)
          if (row == size - 1) {
            places.push_back(row * (row + 1) / 2 + k);
            values.push_back(sign * v(k, column));
          }
        places.push_back(row * (row + 1) / 2 + row);
        values.push_back(sign * t[column]);
      }
      SDPConeSetASparseVecMat(cone_, block_, i, size, 1, 0, places.data(), values.data(),
                              static_cast<int>(places.size()));
    }
    ++block_;
  }

  // a bracket of the largest b'y: the value reached, and the bound proved by the dual
  std::array<double, 2> maximize(const VectorXd& b) {
    for (int i = 0; i < unknowns_; ++i) DSDPSetDualObjective(solver_, i + 1, b[i]);
    DSDPSetGapTolerance(solver_, 1e-10);
    DSDPSetMaxIts(solver_, 500);
    REQUIRE(DSDPSetup(solver_) == 0);
    REQUIRE(DSDPSolve(solver_) == 0);
    REQUIRE(DSDPComputeX(solver_) == 0);
    double reached = 0, proved = 0;
    DSDPGetDObjective(solver_, &reached);
    DSDPGetPObjective(solver_, &proved);
    return {reached, proved};
  }

 private:
  int unknowns_, block_ = 0;
  DSDP solver_ = nullptr;
  SDPCone cone_ = nullptr;
  // DSDP keeps pointers to these
  std::deque<std::vector<int>> places_;
  std::deque<std::vector<double>> values_;
};

// a bracket of the least sum of normal forces that balances the load, each at most `cap`
std::array<double, 2> min_forces(const Grasp& grasp, const Vector6d& load, double cap) {
  const GraspMap map = grasp_map(grasp.points, grasp.com);
  MatrixXd G = map.matrix;
  Vector6d w = load;
  G.bottomRows(3) /= grasp.rho, w.tail<3>() /= grasp.rho;
  // forces f = span y + start, one row per force
  const auto [kernel, start] = test::solutions(G, -w);
  MatrixXd f(map.forces(), kernel.cols() + 1);
  f << kernel, start;
  const int contacts = map.contacts();
  SemidefiniteProgram program(static_cast<int>(kernel.cols()), 2 * contacts);
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(f.cols());
  for (int i = 0; i < contacts; ++i) {
    const PointContact& point = grasp.points[i];
    const int first = map.starts[i], count = map.starts[i + 1] - first;
    MatrixXd across = f.middleRows(first + 1, count - 1);
    if (count == 4) across.row(2) /= point.torsion_radius;
    program.arrow((count > 1 ? point.mu : 1) * f.row(first), across);
    Eigen::RowVectorXd room = -f.row(first);
    room[room.size() - 1] += cap;
    program.arrow(room, MatrixXd(0, f.cols()));
    sum += f.row(first);
  }
  const auto [reached, proved] = program.maximize(-sum.head(kernel.cols()).transpose());
  const double constant = sum[kernel.cols()];
  return {constant - proved, constant - reached};
}

}  // namespace

TEST_CASE("least forces equal those of a semidefinite program") {
  Random random(11);
  int held = 0, tight = 0;
  for (int run = 0; run < 60; ++run) {
    const int contacts = 3 + run % 8;
    const double torsion = run % 3 == 0 ? 0.005 : 0;
    const test::Held h =
        test::held(test::around_ball(contacts, random.uniform(0.3, 1), 100 + run, torsion));
    const Vector6d load =
        wrench(random.normal(), random.normal(), random.normal(), 0.02 * random.normal(),
               0.02 * random.normal(), 0.02 * random.normal());
    const double cap = 20;
    const ForceResult ours = contact_forces(h.world, h.grasp, {.load = load, .max_force = cap});
    if (ours.status != ForceStatus::optimal) continue;
    ++held;
    CAPTURE(run);
    const auto [low, high] = min_forces(h.grasp, load, cap);
    // its steps are solved to some 1e-8 of the objective
    const double close = 1e-7 * ours.objective;
    CHECK(ours.objective > low - close);
    CHECK(ours.objective < high + close);
    tight += high - low < 1e-8 * high;
  }
  CHECK(held > 20);
  CHECK(tight > 0.9 * held);
}
