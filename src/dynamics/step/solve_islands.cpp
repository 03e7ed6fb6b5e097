#include "clench/dynamics/step/solve_islands.h"

#include <algorithm>
#include <utility>

#include "clench/base/watched.h"
#include "clench/dynamics/solve/friction_pyramid.h"
#include "clench/dynamics/solve/friction_residual.h"

namespace clench {

// Residuals of a solution [m/s]: the one requested from the solver, and the one above which a step
// counts as failed: a micrometer in a quarter of an hour.
static constexpr double tolerance = 1e-12, failed_above = 1e-9;
// An island that has contacts, moves slower than this and would gain no more than this under its
// present forces is at rest: it stops, and its forces are kept. The limit of acceleration is a
// millionth of gravity.
static constexpr double rest_speed = 1e-7;         // [m/s, rad/s]
static constexpr double rest_acceleration = 1e-5;  // [m/s^2, rad/s^2]

// Islands of at least heap_trees and heap_rows are solved in the coordinates of their trees; others
// by the matrix of their rows, whose memory grows with the square of the number of rows and whose
// time with the cube. Islands of up to max_dense_rows that the first method fails to solve are
// solved by the second.
static constexpr size_t heap_trees = 6;
static constexpr Eigen::Index heap_rows = 60, max_dense_rows = 240;

bool IslandSolver::rests(const System& system, const StepProblem& problem,
                         const Island& island) const {
  return std::ranges::all_of(island.trees, [&](int t) {
    const Articulation& tree = system.trees[t];
    return problem.v_before.segment(tree.first, tree.size()).cwiseAbs().maxCoeff() < rest_speed;
  });
}

// Blocks, velocities and warm start of an island, with its rows renumbered.
void IslandSolver::gather(const StepProblem& problem, const Island& island) {
  problem_.blocks.clear();
  rows_.clear();
  int count = 0;
  for (const int i : island.blocks) {
    FrictionProblem::Block law = problem.blocks[i].law;
    for (int k = 0; k < law.size(); ++k)
      local_[law.row + k] = count + k, rows_.push_back(law.row + k);
    law.row = count;
    count += law.size();
    problem_.blocks.push_back(law);
  }
  problem_.q.resize(count);
  warm_start_.resize(count);
  for (const int row : rows_) {
    problem_.q[local_[row]] = problem.q[row];
    warm_start_[local_[row]] = problem.warm_start[row];
  }
}

// Do the forces of the last step keep the island at rest? Decided from the velocities that they
// leave, without the matrix of the problem.
bool IslandSolver::holds(const StepProblem& problem, const Island& island,
                         const FrictionOptions& options, FrictionSolution& solution) {
  const Eigen::Index count = warm_start_.size();
  // only its diagonal is used
  if (problem_.W.rows() != count) problem_.W.resize(count, count);
  solution.u = problem_.q;
  for (const int row : rows_) {
    const int k = local_[row];
    problem_.W(k, k) = problem.compliance[row];
    solution.u[k] += problem.compliance[row] * warm_start_[k];
  }
  Eigen::VectorXd change;
  for (const int tree : island.trees) {
    const TreeColumns& columns = problem.columns[tree];
    change.setZero(columns.Y.rows());
    for (size_t i = 0; i < columns.rows.size(); ++i) {
      const auto column = columns.Y.col(static_cast<Eigen::Index>(i));
      const int k = local_[columns.rows[i]];
      change += warm_start_[k] * column;
      problem_.W(k, k) += column.squaredNorm();
    }
    for (size_t i = 0; i < columns.rows.size(); ++i)
      solution.u[local_[columns.rows[i]]] +=
          columns.Y.col(static_cast<Eigen::Index>(i)).dot(change);
  }
  const bool is_pyramid = options.cone == FrictionCone::pyramid;
  std::vector<FrictionProblem::Block> pyramids;
  if (is_pyramid)
    pyramids = std::exchange(problem_.blocks, inscribed_cones(problem_.blocks, options.edges));
  const FrictionFault fault =
      friction_fault(problem_, warm_start_, solution.u, rest_acceleration * problem.h);
  if (is_pyramid) problem_.blocks = std::move(pyramids);
  solution.r = warm_start_;
  solution.residual = fault.largest;
  solution.solved = fault.excess <= 1;
  return solution.solved;
}

// W = J M^-1 J^T of an island, with compliances.
void IslandSolver::assemble(const StepProblem& problem, const Island& island) {
  const Eigen::Index count = problem_.q.size();
  problem_.W.setZero(count, count);
  StopCheck check(64);
  for (const int row : rows_) problem_.W(local_[row], local_[row]) = problem.compliance[row];
  for (const int tree : island.trees) {
    const TreeColumns& columns = problem.columns[tree];
    for (int i = 0; i < static_cast<int>(columns.rows.size()); ++i) {
      check();
      for (int j = 0; j <= i; ++j) {
        const double w = columns.Y.col(i).dot(columns.Y.col(j));
        const int a = local_[columns.rows[i]], b = local_[columns.rows[j]];
        problem_.W(a, b) += w;
        if (i != j) problem_.W(b, a) += w;
      }
    }
  }
}

// Sets trees_ to the problem of the island: its trees, and the columns of its blocks.
void IslandSolver::gather_trees(const System& system, const StepProblem& problem,
                                const Island& island) {
  trees_.clear();
  local_tree_.resize(system.trees.size());
  for (const int t : island.trees) {
    local_tree_[t] = trees_.trees();
    trees_.add_tree(system.trees[t].size());
  }
  for (size_t i = 0; i < island.blocks.size(); ++i) {
    const StepBlock& from = problem.blocks[island.blocks[i]];
    TreeFriction::Block block;
    static_cast<FrictionProblem::Block&>(block) = problem_.blocks[i];
    block.compliance = problem.compliance[from.law.row];
    trees_.blocks.push_back(block);
    for (int side = 0; side < 2; ++side)
      if (const int t = from.tree[side]; t >= 0)
        trees_.add_side(local_tree_[t],
                        problem.columns[t].Y.middleCols(from.column[side], block.size()));
  }
  trees_.q = problem_.q;
  trees_.finish();
}

// Removes the stabilization velocities from q: they may contradict limits and locks, whereas not
// approaching never does.
// returns  true if there were any
bool IslandSolver::leave_out_push(const StepProblem& problem) {
  bool any = false;
  for (const int row : rows_) {
    problem_.q[local_[row]] += problem.push[row];
    any = any || problem.push[row] != 0;
  }
  return any;
}

FrictionSolution IslandSolver::solve_dense(const StepProblem& problem, const Island& island,
                                           const FrictionOptions& options,
                                           const Progress& progress) {
  assemble(problem, island);
  FrictionSolution solution = solver_.solve(problem_, warm_start_, options, progress);
  if (solution.solved || !leave_out_push(problem)) return solution;
  const int iterations = solution.iterations;
  solution = solver_.solve(problem_, warm_start_, options, progress);
  solution.iterations += iterations;
  solution.fell_back = true;
  return solution;
}

// In heaps, stabilization velocities often contradict each other: they are omitted before any other
// starting point is tried.
FrictionSolution IslandSolver::solve_heap(const System& system, const StepProblem& problem,
                                          const Island& island, const FrictionOptions& options,
                                          const Progress& progress) {
  gather_trees(system, problem, island);
  const bool pushes = std::ranges::any_of(rows_, [&](int row) { return problem.push[row] != 0; });
  TreeFrictionOptions by_trees{.tolerance = *options.tolerance, .restarts = !pushes};
  const auto is_acceptable = [&by_trees](const FrictionSolution& s) {
    return s.solved || s.residual <= by_trees.acceptable;
  };
  FrictionSolution solution = tree_solver_.solve(trees_, warm_start_, by_trees, progress);
  int iterations = solution.iterations;
  if (!is_acceptable(solution) && leave_out_push(problem)) {
    trees_.q = problem_.q;
    by_trees.restarts = true;
    solution = tree_solver_.solve(trees_, solution.r, by_trees, progress);
    solution.iterations = iterations += solution.iterations;
    solution.fell_back = true;
    if (!is_acceptable(solution)) {
      const FrictionSolution anew = tree_solver_.solve(trees_, warm_start_, by_trees, progress);
      iterations += anew.iterations;
      if (anew.solved || anew.residual < solution.residual) solution = anew;
      solution.iterations = iterations;
      solution.fell_back = true;
    }
  }
  if (is_acceptable(solution) || problem_.q.size() > max_dense_rows) return solution;
  assemble(problem, island);
  const FrictionSolution dense = solver_.solve(problem_, warm_start_, options, progress);
  iterations += dense.iterations;
  if (dense.solved || dense.residual < solution.residual) solution = dense;
  solution.iterations = iterations;
  solution.fell_back = true;
  return solution;
}

void IslandSolver::solve_island(const System& system, const StepProblem& problem,
                                const Island& island, const FrictionOptions& options,
                                const Progress& progress, StepSolution& out) {
  gather(problem, island);
  const bool at_rest = rests(system, problem, island);
  FrictionSolution solution;
  const bool held = at_rest && holds(problem, island, options, solution);
  if (!held) {
    const bool heap = island.trees.size() >= heap_trees && problem_.q.size() >= heap_rows &&
                      options.cone == FrictionCone::round;
    solution = heap ? solve_heap(system, problem, island, options, progress)
                    : solve_dense(problem, island, options, progress);
  }
  for (const int row : rows_) out.r[row] = solution.r[local_[row]];
  if (at_rest && solution.iterations == 0)
    for (const int t : island.trees) resting_[t] = 1;
  out.iterations += solution.iterations;
  out.fallbacks += solution.fell_back;
  out.failures += !solution.solved && !(solution.residual <= failed_above);
  out.residual = std::max(out.residual, solution.residual);
}

StepSolution IslandSolver::solve(const System& system, const StepProblem& problem,
                                 const DynamicSettings& settings, const Progress& progress) {
  const FrictionOptions options{
      .cone = settings.cone, .edges = settings.cone_edges, .tolerance = tolerance};
  StepSolution out{.v = problem.v_free, .r = Eigen::VectorXd::Zero(problem.rows())};
  local_.resize(problem.rows());
  resting_.assign(system.trees.size(), 0);
  for (const Island& island : problem.islands)
    solve_island(system, problem, island, options, progress, out);
  for (size_t t = 0; t < system.trees.size(); ++t) {
    const TreeColumns& columns = problem.columns[t];
    if (columns.rows.empty()) continue;
    const Articulation& tree = system.trees[t];
    Eigen::VectorXd change = Eigen::VectorXd::Zero(tree.size());
    for (size_t i = 0; i < columns.rows.size(); ++i)
      change += out.r[columns.rows[i]] * columns.Y.col(static_cast<Eigen::Index>(i));
    problem.trees[t].other_half_solve(change);
    auto v = out.v.segment(tree.first, tree.size());
    v += change;
    if (resting_[t] && v.cwiseAbs().maxCoeff() < rest_acceleration * problem.h) v.setZero();
  }
  return out;
}

}  // namespace clench
