// Friction cones as wrenches on an object.
#pragma once
#include <Eigen/Core>

#include "clench/spec/point_contact.h"

namespace clench {

using Wrenches =
    Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< one wrench (force; torque / rho) per column

struct ConeOptions {
  int edges = 8;     ///< of the pyramid about the normal, 3 to max_edges
  double rho = 1.0;  ///< torque length scale, > 0 [m]
  /// reference point of torques, usually the center of mass [m]
  Eigen::Vector3d p_OM = Eigen::Vector3d::Zero();
};

/// Columns x y z of the contact frame: z the unit normal, x = n x e1 (e3 when n is along e1),
/// y = n x x.
Eigen::Matrix3d contact_frame(const Eigen::Vector3d& normal);

/// Generators of a linearized friction cone. Column i is (f; tau/rho) with f = n + mu t_i: unit
/// normal force. Without friction the cone is its normal: one column. A soft contact has more
/// edges, those of friction_edges, with even latitudes in units of its torsion radius: 20 for 8.
///
/// returns  6 x count; of a point contact counter-clockwise about n from the frame's x
/// throws   Error if mu < 0, torsion_radius < 0, edges out of range, rho <= 0, n is not unit or a
///          number is not finite
/// source   Murray, Li & Sastry (1994), ch. 5: grasp map, force rows first
Wrenches cone_wrenches(const PointContact& contact, const ConeOptions& options = {});

/// The wrenches of unit normal force in a round cone: axis + spread x with |x| <= 1.
struct RoundCone {
  Eigen::Matrix<double, 6, 1> axis = Eigen::Matrix<double, 6, 1>::Zero();
  /// both tangents and, for a soft contact, the torque about the normal; no column without friction
  Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 3> spread;
};

/// The limit of cone_wrenches for many edges; `edges` is ignored here.
/// throws  Error as cone_wrenches
RoundCone round_cone(const PointContact& contact, const ConeOptions& options = {});

}  // namespace clench
