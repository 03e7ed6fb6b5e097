#include "clench/dynamics/solve/scaled_friction.h"

#include <cmath>

#include "clench/base/watched.h"
#include "clench/dynamics/solve/friction_residual.h"

namespace clench {

void ScaledFriction::set(const FrictionProblem& problem) {
  const int n = static_cast<int>(problem.q.size());
  const double largest = n > 0 ? problem.W.diagonal().maxCoeff() : 0;
  units.resize(n), weights.resize(n);
  blocks.resize(problem.blocks.size());
  for (size_t i = 0; i < blocks.size(); ++i) {
    ScaledBlock& block = blocks[i];
    static_cast<FrictionProblem::Block&>(block) = problem.blocks[i];
    const double d = block_admittance(problem, block);
    block.moves = d > 1e-30 * largest && d > 1e-200;
    int exponent = 0;
    if (block.moves) std::frexp(d, &exponent);
    // d is in [1/2, 1) 2^exponent
    const double unit = std::ldexp(1.0, -(exponent >> 1));
    block.d = block.moves ? d * unit * unit : 1;
    block.low /= unit, block.high /= unit;
    units.segment(block.row, block.size()).setConstant(unit);
    weights.segment(block.row, block.size()).setConstant(block.d);
  }
  // the same force has the same weight at all contacts of two bodies
  for (size_t first = 0, next; first < blocks.size(); first = next) {
    const int pair = blocks[first].pair;
    double sum = 0;
    for (next = first;
         next < blocks.size() && (next == first || (pair >= 0 && blocks[next].pair == pair));
         ++next)
      sum += blocks[next].d / (units[blocks[next].row] * units[blocks[next].row]);
    const double mean = sum / static_cast<double>(next - first);
    for (size_t i = first; i < next && next - first > 1; ++i)
      weights.segment(blocks[i].row, blocks[i].size())
          .setConstant(mean * units[blocks[i].row] * units[blocks[i].row]);
  }
  S.resize(n, n);
  StopCheck check(256);
  for (int j = 0; j < n; ++j) {
    check();
    S.col(j) = problem.W.col(j).cwiseProduct(units) * units[j];
  }
  q = problem.q.cwiseProduct(units);
}

}  // namespace clench
