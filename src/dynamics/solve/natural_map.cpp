#include "clench/dynamics/solve/natural_map.h"

#include <algorithm>
#include <cmath>

namespace clench {

double natural_map(const FrictionProblem::Block& block, double d, double rho, const double* r,
                   const double* u, BlockState& state, double* slide) {
  const double normal = r[0] - rho * u[0] / d;
  if (!block.is_contact()) {
    state = normal <= block.low    ? BlockState::low
            : normal >= block.high ? BlockState::high
                                   : BlockState::free;
    const double fault = r[0] - std::clamp(normal, block.low, block.high);
    return fault * fault;
  }
  double square = 0, length = 0;
  if (!(normal > 0)) {
    state = BlockState::fixed;
    for (int k = 0; k <= block.tangents; ++k) square += r[k] * r[k];
    return square;
  }
  square = (r[0] - normal) * (r[0] - normal);
  double* t = slide + 1;
  for (int k = 0; k < block.tangents; ++k) {
    t[k] = r[1 + k] - rho * u[1 + k] / d;
    length += t[k] * t[k];
  }
  length = std::sqrt(length);
  const double friction = block.mu * normal;
  if (length <= friction && block.mu > 0) {
    state = BlockState::sticks;
    for (int k = 1; k <= block.tangents; ++k) square += rho * rho * u[k] * u[k] / (d * d);
    return square;
  }
  state = BlockState::slides;
  slide[0] = length > 0 ? friction / length : 0;
  for (int k = 0; k < block.tangents; ++k) {
    if (length > 0) t[k] /= length;
    const double fault = r[1 + k] - friction * t[k];
    square += fault * fault;
  }
  return square;
}

}  // namespace clench
