// A convex set that is known only by how far it reaches in any direction. Includes no Eigen: what is
// built on it may be compiled for the machine at hand.
#pragma once

namespace clench {

inline constexpr int most_dimensions = 6;

/// All directions u with wall . u <= 0 for each wall.
struct DirectionCone {
  static constexpr int most_walls = 5;
  int walls = 0;
  double wall[most_walls][most_dimensions];  ///< unit vectors
};

class SupportSet {
 public:
  virtual ~SupportSet() = default;

  virtual int dimension() const = 0;  ///< 1 to most_dimensions
  /// Leaves a farthest point of the set along the direction in `point`.
  /// returns  direction . point
  virtual double support(const double* direction, double* point) const = 0;
  /// The least support of all directions is found in this cone, too.
  virtual DirectionCone least_support_cone() const { return {}; }
};

}  // namespace clench
