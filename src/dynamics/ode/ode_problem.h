// What a step asks of ODE, and what it gives.
#pragma once
#include "clench/dynamics/control/motors.h"

namespace clench {

/// A point where two bodies touch. ODE's friction is a box: at most mu times the normal force along
/// each of two directions, of which the first is that of sliding; and at most spin_radius times the
/// normal force about the normal.
struct OdeContact {
  Id<Body> a, b;
  Eigen::Vector3d p_W;
  Eigen::Matrix3d frame;           ///< columns: normal from a into b, tangents; world
  double mu = 0, spin_radius = 0;  ///< Coulomb coefficient; torque per normal force [m]
  double target = 0;               ///< least velocity along the normal [m/s]
  /// of belts, b's against a's, world [m/s]
  Eigen::Vector3d surface_velocity = Eigen::Vector3d::Zero();
  /// without contacts, in the frame: tells where it slides
  Eigen::Vector3d free_velocity = Eigen::Vector3d::Zero();
};

struct OdeProblem {
  const System& system;
  const Eigen::VectorXd& v;                ///< before the step, one per coordinate
  const std::vector<JointForces>& forces;  ///< by tree
  /// by tree, at the centre of its root; see TreeDynamics::root_acceleration
  const std::vector<Vector6d>& root_accelerations;
  const std::vector<CoordinateRow>& rows;
  const std::vector<OdeContact>& contacts;
};

struct OdeSolution {
  Eigen::VectorXd v;                      ///< after the step, one per coordinate
  std::vector<double> row_impulses;       ///< one per row
  std::vector<Eigen::Vector3d> impulses;  ///< one per contact, on b, in its frame [N s]
  std::vector<double> spins;              ///< likewise about the normal [N m s]
  /// one per contact, of b against a, belts among them, in its frame [m/s]
  std::vector<Eigen::Vector3d> velocities;
  /// largest fault of a contact's normal velocity or of a coupling [m/s, rad/s]
  double residual = 0;
  /// steps that ODE took: joints that one DOF couples are brought together in several
  int solves = 0;
  bool softened =
      false;           ///< Dantzig's method broke off: contacts were made softer, or ODE iterated
  bool solved = true;  ///< did joints come together, and did ODE not break off to the last?
};

}  // namespace clench
