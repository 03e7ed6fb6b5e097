// Objectives and constraints of contact forces.
#pragma once
#include "clench/grasp/force/joint_balance.h"

namespace clench {

/// Objective among the forces that balance; f_n normal force, f_t the rest: tangential force and
/// torsion over its radius.
enum class ForceObjective {
  /// minimum sum of normal forces
  /// source  Han, Trinkle & Li (2000); Boyd & Wegbreit (2007)
  min_sum,
  min_norm,  ///< minimum sum of f_n^2 + |f_t|^2: the only one whose solution is always unique
  min_max,   ///< minimum of the largest normal force
  /// maximum of the smallest distance of a force from the boundary of its cone, and from its cap
  max_margin,
  max_margin_sum,  ///< maximum sum of the distances from the boundaries of the cones
};

/// Constraints on the forces by the joints.
struct JointDemand {
  /// effort limits of the hand's DOFs, >= 0, in both directions, instead of those of their drives
  /// [N m or N]
  std::optional<Eigen::VectorXd> limits;
  /// efforts are unlimited in the directions in which motors can push
  bool unlimited = false;
  /// prescribed efforts of the hand's motors [N m or N]
  std::optional<Eigen::VectorXd> efforts = {};
  /// tendons of compliant DOFs are locked in place, and clutches of joints that have broken away
  /// exert up to their limit
  bool springs_only = false;
  /// springs of compliant DOFs may deviate from their rest force by springs_at_rest
  bool nearly_at_rest = false;
  bool unilateral = false;  ///< efforts that open the hand are not allowed
  /// prescribed sum of the hand's efforts in the closing direction [N m or N]
  std::optional<double> total_torque;
  bool arms = false;  ///< limits also of the robots that carry the hand
  /// motors also carry the weight of the links, and of robots that they carry
  bool link_weights = false;
};

struct ForceOptions {
  /// external load on the object, world axes, torque about its center of mass [N, N m]
  Vector6d load = Vector6d::Zero();
  ForceObjective objective = ForceObjective::min_sum;
  PerContact max_force = {};                   ///< caps of normal forces, > 0 [N]
  std::optional<double> max_total_force = {};  ///< cap of their sum, > 0 [N]
  std::optional<double> total_force = {};      ///< prescribed sum, > 0 [N]
  std::optional<JointDemand> joints = {};      ///< empty: forces do not depend on motors
  /// minimizes the unbalanced wrench, with torque over rho, instead of requiring balance; the
  /// objective is ignored
  bool nearest = false;
};

}  // namespace clench
