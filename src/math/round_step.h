// Steps that people count in.
#pragma once
#include <cmath>

namespace clench {

/// The smallest of 1, 2 and 5 times powers of ten that is at least x > 0.
inline double round_step(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= x) return digit * power;
  return 10 * power;
}

}  // namespace clench
