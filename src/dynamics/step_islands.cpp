// Stepper: islands of bodies that touch, each solved by itself.
#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/dynamics/solve/friction_residual.h"
#include "clench/dynamics/stepper.h"

namespace clench {

// Faults of a solution [m/s]: what is asked of the solver, and what counts as a failure, a
// micrometre in a quarter of an hour.
static constexpr double tolerance = 1e-12, failed_above = 1e-9;
// What touches, is slower than this and would gain no more than that under the forces that it had
// rests: it stops, and its forces stay. That is a millionth of gravity.
static constexpr double rest_speed = 1e-7;         // [m/s, rad/s]
static constexpr double rest_acceleration = 1e-5;  // [m/s^2, rad/s^2]

void Stepper::find_islands() {
  const size_t trees = trees_.size();
  touching_trees_.reset(trees);
  for (const PlacedBlock& block : blocks_)
    if (block.tree[0] >= 0 && block.tree[1] >= 0)
      touching_trees_.join(block.tree[0], block.tree[1]);
  island_of_.assign(trees, -1);
  // those of the last step keep their room
  size_t count = 0;
  for (size_t i = 0; i < blocks_.size(); ++i) {
    const int tree = blocks_[i].tree[0] >= 0 ? blocks_[i].tree[0] : blocks_[i].tree[1];
    if (tree < 0) continue;
    int& island = island_of_[touching_trees_.find(tree)];
    if (island < 0) {
      island = static_cast<int>(count++);
      if (islands_.size() < count) islands_.emplace_back();
      islands_[island].blocks.clear(), islands_[island].trees.clear();
    }
    islands_[island].blocks.push_back(static_cast<int>(i));
  }
  islands_.resize(count);
  for (size_t t = 0; t < trees; ++t)
    if (const int island = island_of_[touching_trees_.find(static_cast<int>(t))];
        island >= 0 && !tree_rows_[t].rows.empty())
      islands_[island].trees.push_back(static_cast<int>(t));
}

// Do the forces of the last step hold what rests? Answered by the velocities that they leave,
// without the matrix of the problem.
bool Stepper::holds(const Island& island, const Eigen::VectorXd& warm, FrictionSolution& solution,
                    double h) {
  const Eigen::Index count = warm.size();
  // of the matrix its diagonal is enough
  if (problem_.W.rows() != count) problem_.W.resize(count, count);
  solution.u = problem_.q;
  for (const int row : rows_) {
    const int k = local_[row];
    problem_.W(k, k) = compliance_[row];
    solution.u[k] += compliance_[row] * warm[k];
  }
  Eigen::VectorXd change;
  for (const int tree : island.trees) {
    const TreeRows& rows = tree_rows_[tree];
    change.setZero(rows.Y.rows());
    for (size_t i = 0; i < rows.rows.size(); ++i) {
      const auto column = rows.Y.col(static_cast<Eigen::Index>(i));
      const int k = local_[rows.rows[i]];
      change += warm[k] * column;
      problem_.W(k, k) += column.squaredNorm();
    }
    for (size_t i = 0; i < rows.rows.size(); ++i)
      solution.u[local_[rows.rows[i]]] += rows.Y.col(static_cast<Eigen::Index>(i)).dot(change);
  }
  const FrictionFault fault = friction_fault(problem_, warm, solution.u, rest_acceleration * h);
  solution.r = warm;
  solution.residual = fault.largest;
  solution.solved = fault.excess <= 1;
  return solution.solved;
}

void Stepper::assemble(const Island& island, int count) {
  problem_.W.setZero(count, count);
  StopCheck check(64);
  for (const int row : rows_) problem_.W(local_[row], local_[row]) = compliance_[row];
  for (const int tree : island.trees) {
    const TreeRows& rows = tree_rows_[tree];
    for (int i = 0; i < static_cast<int>(rows.rows.size()); ++i) {
      check();
      for (int j = 0; j <= i; ++j) {
        const double w = rows.Y.col(i).dot(rows.Y.col(j));
        const int a = local_[rows.rows[i]], b = local_[rows.rows[j]];
        problem_.W(a, b) += w;
        if (i != j) problem_.W(b, a) += w;
      }
    }
  }
}

void Stepper::solve_island(const Island& island, double h) {
  problem_.blocks.clear();
  rows_.clear();
  int count = 0;
  for (const int i : island.blocks) {
    FrictionProblem::Block law = blocks_[i].law;
    for (int k = 0; k < law.size(); ++k)
      local_[law.row + k] = count + k, rows_.push_back(law.row + k);
    law.row = count;
    count += law.size();
    problem_.blocks.push_back(law);
  }
  // what rests keeps the forces that it has as long as they hold it
  bool at_rest = true;
  for (const int t : island.trees)
    at_rest =
        at_rest &&
        v_before_.segment(system_.trees[t].first, system_.trees[t].size()).cwiseAbs().maxCoeff() <
            rest_speed;
  problem_.q.resize(count);
  Eigen::VectorXd warm(count);
  for (const int row : rows_) {
    problem_.q[local_[row]] = q_[row];
    warm[local_[row]] = warm_[row];
  }
  const DynamicSettings& settings = world_.dynamic_settings();
  FrictionSolution solution;
  const bool held =
      at_rest && settings.cone == FrictionCone::round && holds(island, warm, solution, h);
  if (!held) {
    assemble(island, count);
    solution =
        solver_.solve(problem_, warm,
                      {.cone = settings.cone, .edges = settings.cone_edges, .tolerance = tolerance},
                      world_.context().progress());
  }
  for (const int row : rows_) r_[row] = solution.r[local_[row]];
  if (at_rest && solution.iterations == 0)
    for (const int t : island.trees) resting_[t] = true;
  StepReport& report = world_.edit_dynamics().report;
  report.iterations += solution.iterations;
  report.fallbacks += solution.fell_back;
  report.failures += !solution.solved && !(solution.residual <= failed_above);
  report.residual = std::max(report.residual, solution.residual);
}

void Stepper::apply_impulses(double h) {
  for (size_t t = 0; t < trees_.size(); ++t) {
    const TreeRows& rows = tree_rows_[t];
    if (rows.rows.empty()) continue;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(system_.trees[t].size());
    for (size_t i = 0; i < rows.rows.size(); ++i)
      change += r_[rows.rows[i]] * rows.Y.col(static_cast<Eigen::Index>(i));
    trees_[t].other_half_solve(change);
    auto v = v_.segment(system_.trees[t].first, system_.trees[t].size());
    v += change;
    if (resting_[t] && v.cwiseAbs().maxCoeff() < rest_acceleration * h) v.setZero();
  }
}

}  // namespace clench
