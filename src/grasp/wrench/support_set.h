// A convex set that is known only by how far it reaches in any direction. Includes no Eigen: what
// is built on it may be compiled for the machine at hand.
#pragma once

namespace clench {

inline constexpr int max_dimensions = 6;

class SupportSet {
 public:
  virtual ~SupportSet() = default;

  virtual int dimension() const = 0;  ///< 1 to max_dimensions
  /// Leaves a farthest point of the set along the direction in `point`.
  /// returns  direction . point
  virtual double support(const double* direction, double* point) const = 0;
};

}  // namespace clench
