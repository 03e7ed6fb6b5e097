// Contact forces that balance a load on an object, within friction, caps and the efforts of the
// hand's joints.
#pragma once
#include "clench/grasp/force/force_options.h"

namespace clench {

struct ContactForce {
  double normal = 0;  ///< [N]
  /// along x and y of contact_frame(n_W) [N]
  Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
  double torsion = 0;                                 ///< about the normal [N m]
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();  ///< on the object [N]
  double margin = 0;  ///< distance from the boundary of the cone; negative: outside [N]
};

enum class ForceStatus {
  optimal,
  infeasible,  ///< proved: no forces of up to 1e12 times the required size balance it
  unbounded,   ///< the objective grows without limit: a cap is missing
  inaccurate,  ///< the result does not pass its check: the best available
};

/// Proof that a load cannot be balanced: a small motion of the object and of the hand's joints
/// along which the load does more work than all that caps and motors can resist.
struct ForceCertificate {
  /// of the object, world axes, about its center of mass; |(v, rho w)| = 1
  Vector6d twist = Vector6d::Zero();
  /// of the load along it, or of the largest load if that was requested [W at m/s]
  double power = 0;
  /// maximum power of caps, motors and springs against it: less than `power`; equal to it for the
  /// largest load
  double capacity = 0;
  std::vector<double> separation_rates,
      /// per contact: velocity at which the object leaves it and slides along it [m/s]
      sliding_rates;
  std::vector<double> force_limit_power;  ///< per contact: share of the capacity due to its cap [W]
  std::vector<double> effort_limit_power;  ///< per DOF of the hand: share due to its limits [W]
  int contact = -1;                        ///< the contact with the largest share; -1: none
  int dof = -1;  ///< the DOF whose motor has a larger share than any contact; otherwise -1
};

struct ForceResult {
  ForceStatus status = ForceStatus::inaccurate;
  double objective = 0;                    ///< value of the ForceObjective [N or N^2]
  std::vector<ContactForce> forces;        ///< one per contact of the grasp
  Vector6d unbalanced = Vector6d::Zero();  ///< sum of load and forces, world axes
  double residual = 0;                     ///< its length, torque over rho [N]
  /// smallest distance of a force from the boundary of its cone, and for `max_margin` from its cap;
  /// 0: some force lies on the boundary, and for `max_margin` all solutions do, as without force
  /// closure [N]
  double margin = 0;
  /// of the hand's motors; without `joints`: those that fit best [N m or N]
  Eigen::VectorXd efforts;
  double load_factor = 0;  ///< of max_load
  std::optional<ForceCertificate> certificate = {};
};

/// throws  Error if an option is invalid, or as check_unmoved does
void check_force_options(const World& world, const Grasp& grasp, const ForceOptions& options);

/// A grasp without contacts is valid: only a zero load is balanced.
/// throws  Error if an option is invalid, or as check_unmoved does
ForceResult contact_forces(const World& world, const Grasp& grasp, const ForceOptions& options);

/// The largest multiple of the load's direction, options.load, that forces balance, as load_factor;
/// the objective is ignored. unbounded: any multiple. The certificate names what yields beyond it.
/// throws  Error as above, and if the load is 0
ForceResult max_load(const World& world, const Grasp& grasp, const ForceOptions& options);

}  // namespace clench
