// Parameters of a hand's torques, fitted so that contact forces balance the joints.
#pragma once
#include "clench/grasp/force/force_options.h"
#include "clench/math/cone_program.h"

namespace clench {

/// Torques of the hand's DOFs that depend linearly on parameters: base + columns * parameters.
struct TorqueFamily {
  Eigen::VectorXd base;       ///< one per DOF [N m or N]
  Eigen::MatrixXd columns;    ///< DOFs x parameters
  Eigen::VectorXd low, high;  ///< of the parameters, low <= high
};

struct TorqueFitOptions {
  Vector6d load = Vector6d::Zero();  ///< on the object, as in ForceOptions
  PerContact max_force = {};         ///< caps of normal forces, > 0 [N]
  bool link_weights = false;         ///< torques also carry the weight of the links
};

struct TorqueFit {
  /// infeasible: no contact forces balance the load; inaccurate: the result does not pass its check
  ConeStatus status = ConeStatus::inaccurate;
  Eigen::VectorXd parameters, torques;  ///< torques: one per DOF [N m or N]
  Eigen::VectorXd errors;   ///< unbalanced torque of each joint row of JointBalance [N m or N]
  double error = 0;         ///< its length
  Eigen::VectorXd normals;  ///< normal force of each contact [N]
};

/// The parameters, and contact forces within their cones that balance the load, for which the
/// unbalanced torques of the joints are smallest. Springs of compliant DOFs and clutches act as in
/// equilibrium().
/// throws  Error if sizes do not match, a range is empty or a number is not finite, or as
///         contact_forces does
/// source  Ciocarlie & Allen
///         (2011), A constrained optimization framework for compliant underactuated grasping
TorqueFit fit_torques(const World& world, const Grasp& grasp, const TorqueFamily& family,
                      const TorqueFitOptions& options);

}  // namespace clench
