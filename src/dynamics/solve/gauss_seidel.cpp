#include "clench/dynamics/solve/gauss_seidel.h"

#include <algorithm>

#include "clench/base/watched.h"

namespace clench {

void GaussSeidel::set(const ScaledFriction& problem, double damping) {
  damping_ = damping;
  contacts_.resize(problem.blocks.size());
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    if (block.is_contact() && block.moves)
      contacts_[i].set(block.mu, block.tangents, &problem.S(block.row, block.row), problem.rows(),
                       damping * block.d);
  }
}

void GaussSeidel::sweep(const ScaledFriction& problem, int sweeps, Eigen::VectorXd& r) {
  const int count = static_cast<int>(problem.blocks.size());
  StopCheck check(64);
  for (int s = 0; s < sweeps; ++s) {
    for (int k = 0; k < count; ++k) {
      const int i = s % 2 == 0 ? k : count - 1 - k;
      const auto& block = problem.blocks[i];
      if (!block.moves) continue;
      check();
      const int row = block.row, size = block.size();
      // velocities of its rows due to all other impulses
      double q[4];
      for (int a = 0; a < size; ++a) {
        q[a] = problem.q[row + a] + problem.S.col(row + a).dot(r);
        for (int b = 0; b < size; ++b) q[a] -= problem.S(row + a, row + b) * r[row + b];
      }
      if (block.is_contact())
        contacts_[i].solve(q, &r[row]);
      else
        r[row] =
            std::clamp(-q[0] / (problem.S(row, row) + damping_ * block.d), block.low, block.high);
    }
  }
}

}  // namespace clench
