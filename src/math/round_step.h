// Round step sizes for scales and grids.
#pragma once
#include <cmath>

namespace clench {

/// The smallest number of the form 1, 2 or 5 times a power of ten that is at least x > 0.
inline double round_step(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= x) return digit * power;
  return 10 * power;
}

}  // namespace clench
