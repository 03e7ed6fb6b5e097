// Which contact forces hold an object against a load, within friction, caps and what the hand's joints can give.
#pragma once
#include "grasp/joint_balance.h"

namespace clench {

/// What is best among the forces that balance; f_n normal force, f_t the rest: tangential force and torsion over its
/// radius.
enum class ForceObjective {
  min_sum,  ///< least sum of normal forces   source  Han, Trinkle & Li (2000); Boyd & Wegbreit (2007)
  min_norm,    ///< least sum of f_n^2 + |f_t|^2: the only one that is always unique
  min_max,     ///< least largest normal force
  max_margin,  ///< largest distance that each force keeps from the edge of its cone, and from its cap
  max_margin_sum,  ///< largest sum of the distances from the cones
};

/// What the joints ask of the forces.
struct JointDemand {
  std::optional<Eigen::VectorXd>
      limits;              ///< of the hand's DOFs either way, >= 0, instead of theirs [N m or N]
  bool unlimited = false;  ///< motors give whatever it takes
  std::optional<Eigen::VectorXd> efforts = {};  ///< what the hand's motors give [N m or N]
  /// tendons of compliant DOFs are held where they stand, and clutches of joints that have broken away give all they can
  bool springs_only = false;
  /// springs of compliant DOFs may be off their rest by springs_at_rest
  bool nearly_at_rest = false;
  bool unilateral = false;  ///< efforts that open the hand are not allowed
  std::optional<double>
      total_torque;           ///< sum of the hand's efforts, along which it closes [N m or N]
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

struct ContactForce {
  double normal = 0;  ///< [N]
  Eigen::Vector2d tangential =
      Eigen::Vector2d::Zero();                        ///< along x and y of contact_frame(n_W) [N]
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

/// Proof that a load is too much: a small motion of the object and of the hand's joints that gives way to it. Along it
/// the load does more work than all that caps and motors can hold against it.
struct ForceCertificate {
  Vector6d twist =
      Vector6d::Zero();  ///< of the object, world axes, about its centre of mass; |(v, rho w)| = 1
  double power =
      0;  ///< of the load along it, of the largest one where that was asked for [W at m/s]
  double capacity =
      0;  ///< most that caps, motors and springs give against it: less than the power; equal, of the largest load
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
  /// the least distance that a force keeps from the edge of its cone, and of `max_margin` from its cap; 0: some force lies
  /// on its edge, and for `max_margin` no forces keep away from it, as without force closure [N]
  double margin = 0;
  Eigen::VectorXd efforts;  ///< of the hand's motors; without `joints`: that fit best [N m or N]
  double load_factor = 0;   ///< of max_load
  std::optional<ForceCertificate> certificate = {};
};

/// No contacts are no error: nothing holds only what is no load.
/// throws  Error when an option is out of order, or as check_unmoved does
ForceResult contact_forces(const World& world, const Grasp& grasp, const ForceOptions& options);

/// The largest multiple of the load's direction, options.load, that forces balance, as load_factor; the objective does
/// not count. unbounded: any. The certificate says what gives way beyond it.
/// throws  Error as above, and when the load is 0
ForceResult max_load(const World& world, const Grasp& grasp, const ForceOptions& options);

}  // namespace clench
