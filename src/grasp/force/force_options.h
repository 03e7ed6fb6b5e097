// What is asked of contact forces.
#pragma once
#include "clench/grasp/force/joint_balance.h"

namespace clench {

/// What is best among the forces that balance; f_n normal force, f_t the rest: tangential force and
/// torsion over its radius.
enum class ForceObjective {
  /// least sum of normal forces   source  Han, Trinkle & Li (2000); Boyd & Wegbreit (2007)
  min_sum,
  min_norm,  ///< least sum of f_n^2 + |f_t|^2: the only one that is always unique
  min_max,   ///< least largest normal force
  /// largest distance that each force keeps from the edge of its cone, and from its cap
  max_margin,
  max_margin_sum,  ///< largest sum of the distances from the cones
};

/// What the joints ask of the forces.
struct JointDemand {
  /// of the hand's DOFs, >= 0, in both directions, instead of what their drives exert [N m or N]
  std::optional<Eigen::VectorXd> limits;
  /// motors exert whatever it takes, in the directions in which they exert anything
  bool unlimited = false;
  std::optional<Eigen::VectorXd> efforts = {};  ///< what the hand's motors give [N m or N]
  /// tendons of compliant DOFs are held where they stand, and clutches of joints that have broken
  /// away give all they can
  bool springs_only = false;
  /// springs of compliant DOFs may be off their rest by springs_at_rest
  bool nearly_at_rest = false;
  bool unilateral = false;  ///< efforts that open the hand are not allowed
  /// sum of the hand's efforts, along which it closes [N m or N]
  std::optional<double> total_torque;
  bool arms = false;          ///< limits of the robots that carry the hand, too
  bool link_weights = false;  ///< motors hold the links up as well, and what robots they carry
};

struct ForceOptions {
  /// on the object from outside, world axes, torque about its centre of mass [N, N m]
  Vector6d load = Vector6d::Zero();
  ForceObjective objective = ForceObjective::min_sum;
  PerContact max_force = {};                   ///< caps of normal forces, > 0 [N]
  std::optional<double> max_total_force = {};  ///< of their sum, > 0 [N]
  std::optional<double> total_force = {};      ///< their sum is this, > 0 [N]
  std::optional<JointDemand> joints = {};      ///< empty: forces need no motor
  /// not balance but the least unbalanced wrench, its torque over rho; the objective does not count
  bool nearest = false;
};

}  // namespace clench
