// Input and output of a step solved by ODE.
#pragma once
#include "clench/dynamics/control/motors.h"

namespace clench {

/// A contact point of two bodies. ODE's friction is a box: at most mu times the normal force along
/// each of two directions, the first of which is that of sliding; and at most spin_radius times the
/// normal force about the normal.
struct OdeContact {
  Id<Body> a, b;
  Eigen::Vector3d p_W;
  Eigen::Matrix3d frame;           ///< columns: normal from a into b, tangents; world
  double mu = 0, spin_radius = 0;  ///< Coulomb coefficient; torque per normal force [m]
  double target = 0;               ///< minimum velocity along the normal [m/s]
  /// velocity of b's belt relative to a's, world [m/s]
  Eigen::Vector3d surface_velocity = Eigen::Vector3d::Zero();
  /// velocity without contacts, in the contact frame: defines the direction of sliding
  Eigen::Vector3d free_velocity = Eigen::Vector3d::Zero();
};

struct OdeProblem {
  const System& system;
  const Eigen::VectorXd& v;                ///< before the step, one per coordinate
  const std::vector<JointForces>& forces;  ///< by tree
  /// by tree, at the center of its root; see TreeDynamics::root_acceleration
  const std::vector<Vector6d>& root_accelerations;
  const std::vector<CoordinateRow>& rows;
  const std::vector<OdeContact>& contacts;
};

struct OdeSolution {
  Eigen::VectorXd v;                      ///< after the step, one per coordinate
  std::vector<double> row_impulses;       ///< one per row
  std::vector<Eigen::Vector3d> impulses;  ///< one per contact, on b, in its frame [N s]
  std::vector<double> spins;              ///< likewise about the normal [N m s]
  /// relative velocity of b against a, one per contact, belts included, in its frame [m/s]
  std::vector<Eigen::Vector3d> velocities;
  /// largest residual of a contact's normal velocity or of a coupling [m/s, rad/s]
  double residual = 0;
  /// number of ODE's steps: couplings of joints by one DOF are reached in several
  int solves = 0;
  bool softened = false;  ///< Dantzig's method failed: contacts were made softer, or ODE iterated
  bool solved = true;     ///< do the couplings hold, and did ODE succeed in the last step?
};

}  // namespace clench
