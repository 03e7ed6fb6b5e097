// Which contact forces hold an object against a load, within friction, caps and what the hand's
// joints can give.
#pragma once
#include "clench/grasp/force/force_options.h"

namespace clench {

struct ContactForce {
  double normal = 0;  ///< [N]
  /// along x and y of contact_frame(n_W) [N]
  Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
  double torsion = 0;                                 ///< about the normal [N m]
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();  ///< on the object [N]
  double margin = 0;  ///< distance from the edge of the cone; below 0: outside [N]
};

enum class ForceStatus {
  optimal,
  infeasible,  ///< proved: no forces up to 1e12 times what is asked for do it
  unbounded,   ///< the more force the better: a cap is missing
  inaccurate,  ///< what was found does not pass its check: the best there is
};

/// Proof that a load is too much: a small motion of the object and of the hand's joints that gives
/// way to it. Along it the load does more work than all that caps and motors can hold against it.
struct ForceCertificate {
  /// of the object, world axes, about its centre of mass; |(v, rho w)| = 1
  Vector6d twist = Vector6d::Zero();
  /// of the load along it, of the largest one where that was asked for [W at m/s]
  double power = 0;
  /// most that caps, motors and springs give against it: less than the power; equal, of the largest
  /// load
  double capacity = 0;
  std::vector<double> separation_rates,
      sliding_rates;  ///< a contact: how fast the object leaves it, and slides along it [m/s]
  std::vector<double> force_limit_power;   ///< a contact: what of the capacity its cap gives [W]
  std::vector<double> effort_limit_power;  ///< a DOF of the hand: what its limits give [W]
  int contact = -1;                        ///< that gives way most; -1: none
  int dof = -1;  ///< whose motor does, when that is more than any contact; else -1
};

struct ForceResult {
  ForceStatus status = ForceStatus::inaccurate;
  double objective = 0;                    ///< what ForceObjective names [N or N^2]
  std::vector<ContactForce> forces;        ///< one per contact of the grasp
  Vector6d unbalanced = Vector6d::Zero();  ///< load and forces together, world axes
  double residual = 0;                     ///< its length, torque over rho [N]
  /// the least distance that a force keeps from the edge of its cone, and of `max_margin` from its
  /// cap; 0: some force lies on its edge, and for `max_margin` no forces keep away from it, as
  /// without force closure [N]
  double margin = 0;
  Eigen::VectorXd efforts;  ///< of the hand's motors; without `joints`: that fit best [N m or N]
  double load_factor = 0;   ///< of max_load
  std::optional<ForceCertificate> certificate = {};
};

/// No contacts are no error: nothing holds only what is no load.
/// throws  Error when an option is out of order, or as check_unmoved does
ForceResult contact_forces(const World& world, const Grasp& grasp, const ForceOptions& options);

/// The largest multiple of the load's direction, options.load, that forces balance, as load_factor;
/// the objective does not count. unbounded: any. The certificate says what gives way beyond it.
/// throws  Error as above, and when the load is 0
ForceResult max_load(const World& world, const Grasp& grasp, const ForceOptions& options);

}  // namespace clench
