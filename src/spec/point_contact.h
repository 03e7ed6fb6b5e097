// A contact of a grasp as a value.
#pragma once
#include <Eigen/Core>

namespace clench {

/// A point at which a finger presses on an object; vectors in the object frame O.
struct PointContact {
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();   ///< contact point [m]
  Eigen::Vector3d n_O = Eigen::Vector3d::UnitZ();  ///< unit normal, into the object
  double mu = 1.0;                                 ///< Coulomb coefficient, >= 0
  /// of torsional friction of a soft contact, 0 for a point contact [m]: with forces f and torque
  /// t, |f_tangential|^2 + (t / torsion_radius)^2 <= (mu f_normal)^2
  double torsion_radius = 0;
};

inline constexpr int max_edges = 1000;  ///< far more than six-dimensional hulls can use
/// selects the round cone itself where either a pyramid or a cone is possible
inline constexpr int round_edges = 0;

}  // namespace clench
