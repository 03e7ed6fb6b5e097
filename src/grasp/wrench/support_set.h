// A convex set given by its support function. Includes no Eigen: code that uses it may be compiled
// for the host's instruction set.
#pragma once

namespace clench {

inline constexpr int max_dimensions = 6;

class SupportSet {
 public:
  virtual ~SupportSet() = default;

  virtual int dimension() const = 0;  ///< 1 to max_dimensions
  /// Writes a farthest point of the set along the direction to `point`.
  /// returns  direction . point
  virtual double support(const double* direction, double* point) const = 0;
};

}  // namespace clench
