// Stepper: islands of bodies that touch, each solved by itself.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "clench/dynamics/solve/friction_residual.h"
#include "clench/dynamics/stepper.h"

namespace clench {

// Faults of a solution [m/s].
static constexpr double tolerance = 1e-12;
// What touches, is slower than this and would gain no more than that in a step under the forces that it had rests: it stops, and
// its forces stay. In a step of 1 ms that is a millionth of gravity [m/s, rad/s].
static constexpr double rest_speed = 1e-7, rest_tolerance = 1e-8;

// Blocks that share a tree, straight or through others.
std::vector<std::vector<int>> Stepper::find_islands() const {
  std::vector<int> leader(trees_.size());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int t) {
    while (leader[t] != t) t = leader[t] = leader[leader[t]];
    return t;
  };
  for (const Block& block : blocks_)
    if (block.tree[0] >= 0 && block.tree[1] >= 0) {
      const int a = find(block.tree[0]), b = find(block.tree[1]);
      leader[std::max(a, b)] = std::min(a, b);
    }
  std::vector<int> island_of(trees_.size(), -1);
  std::vector<std::vector<int>> islands;
  for (size_t i = 0; i < blocks_.size(); ++i) {
    const int tree = blocks_[i].tree[0] >= 0 ? blocks_[i].tree[0] : blocks_[i].tree[1];
    if (tree < 0) continue;
    int& island = island_of[find(tree)];
    if (island < 0) {
      island = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[island].push_back(static_cast<int>(i));
  }
  return islands;
}

// Do the forces of the last step hold what rests? Answered by the velocities that they leave, without the matrix of the problem.
bool Stepper::holds(const std::vector<int>& local, const Eigen::VectorXd& warm, FrictionSolution& solution) {
  const Eigen::Index count = warm.size();
  // of the matrix its diagonal is enough
  if (problem_.W.rows() != count) problem_.W.resize(count, count);
  solution.u = problem_.q;
  for (int row = 0; row < row_count_; ++row) {
    if (local[row] < 0) continue;
    problem_.W(local[row], local[row]) = compliance_[row];
    solution.u[local[row]] += compliance_[row] * warm[local[row]];
  }
  Eigen::VectorXd change;
  for (const TreeRows& rows : tree_rows_) {
    if (rows.rows.empty() || local[rows.rows[0]] < 0) continue;
    change.setZero(rows.Y.rows());
    for (size_t i = 0; i < rows.rows.size(); ++i) {
      const auto column = rows.Y.col(static_cast<Eigen::Index>(i));
      const int k = local[rows.rows[i]];
      change += warm[k] * column;
      problem_.W(k, k) += column.squaredNorm();
    }
    for (size_t i = 0; i < rows.rows.size(); ++i)
      solution.u[local[rows.rows[i]]] += rows.Y.col(static_cast<Eigen::Index>(i)).dot(change);
  }
  const FrictionFault fault = friction_fault(problem_, warm, solution.u, rest_tolerance);
  solution.r = warm;
  solution.residual = fault.largest;
  solution.solved = fault.excess <= 1;
  return solution.solved;
}

void Stepper::assemble(const std::vector<int>& local, int count) {
  problem_.W.setZero(count, count);
  for (int row = 0; row < row_count_; ++row)
    if (local[row] >= 0) problem_.W(local[row], local[row]) = compliance_[row];
  for (const TreeRows& rows : tree_rows_) {
    const int columns = static_cast<int>(rows.rows.size());
    if (columns == 0 || local[rows.rows[0]] < 0) continue;
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j <= i; ++j) {
        const double w = rows.Y.col(i).dot(rows.Y.col(j));
        const int a = local[rows.rows[i]], b = local[rows.rows[j]];
        problem_.W(a, b) += w;
        if (i != j) problem_.W(b, a) += w;
      }
  }
}

void Stepper::solve_island(const std::vector<int>& blocks) {
  std::vector<int> local(row_count_, -1);
  problem_.blocks.clear();
  int count = 0;
  for (const int i : blocks) {
    FrictionProblem::Block law = blocks_[i].law;
    for (int k = 0; k < law.size(); ++k) local[law.row + k] = count + k;
    law.row = count;
    count += law.size();
    problem_.blocks.push_back(law);
  }
  // what rests keeps the forces that it has as long as they hold it
  bool at_rest = true;
  for (const int i : blocks)
    for (const int t : blocks_[i].tree)
      at_rest = at_rest && (t < 0 || v_before_.segment(system_.trees[t].first, system_.trees[t].size()).cwiseAbs().maxCoeff() < rest_speed);
  problem_.q.resize(count);
  Eigen::VectorXd warm(count);
  for (int row = 0; row < row_count_; ++row) {
    if (local[row] < 0) continue;
    problem_.q[local[row]] = q_[row];
    warm[local[row]] = warm_[row];
  }
  const DynamicSettings& settings = world_.dynamic_settings();
  FrictionSolution solution;
  const bool held = at_rest && settings.cone == FrictionCone::round && holds(local, warm, solution);
  if (!held) {
    assemble(local, count);
    solution = solver_.solve(
        problem_, warm, {.cone = settings.cone, .edges = settings.cone_edges, .tolerance = 1, .speed = tolerance});
  }
  for (int row = 0; row < row_count_; ++row) {
    if (local[row] < 0) continue;
    r_[row] = solution.r[local[row]];
  }
  if (at_rest && solution.iterations == 0)
    for (const int i : blocks)
      for (const int t : blocks_[i].tree)
        if (t >= 0) resting_[t] = true;
  StepReport& report = world_.edit_dynamics().report;
  report.iterations += solution.iterations;
  report.fallbacks += solution.fell_back;
  report.failures += !solution.solved;
  report.residual = std::max(report.residual, solution.residual);
}

void Stepper::apply_impulses() {
  for (size_t t = 0; t < trees_.size(); ++t) {
    const TreeRows& rows = tree_rows_[t];
    if (rows.rows.empty()) continue;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(system_.trees[t].size());
    for (size_t i = 0; i < rows.rows.size(); ++i) change += r_[rows.rows[i]] * rows.Y.col(static_cast<Eigen::Index>(i));
    trees_[t].other_half_solve(change);
    auto v = v_.segment(system_.trees[t].first, system_.trees[t].size());
    v += change;
    if (resting_[t] && v.cwiseAbs().maxCoeff() < rest_speed) v.setZero();
  }
}

}  // namespace clench
