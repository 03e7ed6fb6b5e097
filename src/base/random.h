// Random numbers, identical on all platforms, derived from (seed, item), passed by argument.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

#include "clench/base/hash.h"

namespace clench {

/// source  Steele, Lea & Flood (2014), SplitMix64
class Random {
 public:
  explicit Random(uint64_t seed, uint64_t item = 0)
      : state_(Hasher::mix(seed) ^ Hasher::mix(~item)) {}

  uint64_t bits() {
    const uint64_t out = Hasher::mix(state_);
    state_ += 0x9e3779b97f4a7c15u;
    return out;
  }
  /// uniform in [0, 1)
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// uniform in [low, high)
  double uniform(double low, double high) {
    const double share = uniform(), range = high - low;
    return std::isfinite(range) ? low + range * share : low * (1 - share) + high * share;
  }
  /// standard normal (Box and Muller 1958)
  double normal() {
    const double r = std::sqrt(-2 * std::log(1 - uniform()));
    return r * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  uint64_t state_;
};

}  // namespace clench
