// A friction problem scaled so that all blocks have similar admittances.
#pragma once
#include "clench/dynamics/solve/friction_problem.h"

namespace clench {

/// Rows are multiplied by a power of two per block, which is exact: then the mean of each block's
/// diagonal is within 1/2 and 2, so that a feather between boulders is as well posed as a boulder.
struct ScaledFriction {
  struct ScaledBlock : FrictionProblem::Block {
    double d = 1;  ///< mean of its diagonal
    /// false: no impulse changes its velocity; its own impulse is determined beforehand
    bool moves = true;
  };
  Eigen::MatrixXd S;
  Eigen::VectorXd q;
  /// scale of a row: impulses are multiplied by it, velocities divided
  Eigen::VectorXd units;
  Eigen::VectorXd weights;  ///< d of the row's block; for contacts of one pair their mean
  std::vector<ScaledBlock> blocks;

  void set(const FrictionProblem& problem);
  int rows() const { return static_cast<int>(q.size()); }
};

}  // namespace clench
