// Blocks solved one after another, each exactly.
#pragma once
#include <vector>

#include "clench/dynamics/solve/contact_block.h"
#include "clench/dynamics/solve/scaled_friction.h"

namespace clench {

/// Block Gauss-Seidel with `damping * weights` added to the diagonal of S: slow to converge, but
/// robust.
/// source  Jourdan, Alart & Jean (1998), A Gauss-Seidel like algorithm to solve frictional contact
///         problems
class GaussSeidel {
 public:
  void set(const ScaledFriction& problem, double damping);
  /// Every second sweep runs backwards.
  void sweep(const ScaledFriction& problem, int sweeps, Eigen::VectorXd& r);

 private:
  std::vector<ContactBlock> contacts_;
  double damping_ = 0;
};

}  // namespace clench
