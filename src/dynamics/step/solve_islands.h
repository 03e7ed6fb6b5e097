// Solves the islands of a step, one after another.
#pragma once
#include "clench/dynamics/solve/solve_friction.h"
#include "clench/dynamics/solve/solve_trees.h"
#include "clench/dynamics/step/step_problem.h"

namespace clench {

/// Small islands are solved by the matrix of their rows, large ones in the coordinates of their
/// trees. Keeps only scratch memory between steps: the same problem gives the same bits.
class IslandSolver {
 public:
  /// An island at rest keeps its forces as long as they balance it, and is then bit-exactly at
  /// rest.
  /// throws  Stopped
  StepSolution solve(const System& system, const StepProblem& problem,
                     const DynamicSettings& settings, const Progress& progress);

 private:
  bool rests(const System& system, const StepProblem& problem, const Island& island) const;
  void gather(const StepProblem& problem, const Island& island);
  bool holds(const StepProblem& problem, const Island& island, const FrictionOptions& options,
             FrictionSolution& solution);
  bool leave_out_push(const StepProblem& problem);
  void assemble(const StepProblem& problem, const Island& island);
  void gather_trees(const System& system, const StepProblem& problem, const Island& island);
  FrictionSolution solve_dense(const StepProblem& problem, const Island& island,
                               const FrictionOptions& options, const Progress& progress);
  FrictionSolution solve_heap(const System& system, const StepProblem& problem,
                              const Island& island, const FrictionOptions& options,
                              const Progress& progress);
  void solve_island(const System& system, const StepProblem& problem, const Island& island,
                    const FrictionOptions& options, const Progress& progress, StepSolution& out);

  std::vector<int> rows_;               // of the island that is being solved
  std::vector<int> local_;              // by row of the step: its row in the problem of its island
  std::vector<unsigned char> resting_;  // by tree
  Eigen::VectorXd warm_start_;
  FrictionProblem problem_;
  FrictionSolver solver_;
  TreeFriction trees_;
  TreeFrictionSolver tree_solver_;
  std::vector<int> local_tree_;  // by tree of the step: its index in its island
};

}  // namespace clench
