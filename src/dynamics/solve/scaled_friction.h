// A friction problem whose blocks all move about as much as they are pushed.
#pragma once
#include "clench/dynamics/solve/friction_problem.h"

namespace clench {

/// Rows times a power of two per block, which changes no digit: then a mean of each block's
/// diagonal is within 1/2 and 2, so that a feather between boulders is as well posed as a boulder.
struct ScaledFriction {
  struct ScaledBlock : FrictionProblem::Block {
    double d = 1;       ///< mean of its diagonal
    bool moves = true;  ///< false: no impulse changes its velocity; its own is decided beforehand
  };
  Eigen::MatrixXd S;
  Eigen::VectorXd q;
  /// one of a row is so many of the problem's: impulses times it, velocities divided by it
  Eigen::VectorXd units;
  Eigen::VectorXd weights;  ///< d of the row's block; of contacts of one pair their mean
  std::vector<ScaledBlock> blocks;

  void set(const FrictionProblem& problem);
  int rows() const { return static_cast<int>(q.size()); }
};

}  // namespace clench
