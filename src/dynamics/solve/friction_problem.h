// The problem of a step: impulses of contacts, joint limits and motors, and the resulting
// velocities.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

namespace clench {

/// Unknown impulses r and velocities u = W r + q of one island of bodies, in blocks of rows. A
/// block has one of two kinds.
///
/// A contact, 1 + tangents rows: u_n >= 0, r_n >= 0, u_n r_n = 0; |r_t| <= mu r_n, and if u_t is
/// not 0, r_t = -mu r_n u_t / |u_t|: Coulomb's law, without dilatancy: sliding does not lift the
/// bodies. Rows of torsion are scaled by the torsion radius, so that the friction cone is round.
///
/// A bounded row, such as a limit of a joint (0 to infinity), a motor (-effort to effort, its
/// compliance on W's diagonal), dry friction of a joint, or an equation (no bounds): low <= r <=
/// high; u = 0 if r is between the bounds, u >= 0 at low, u <= 0 at high.
struct FrictionProblem {
  struct Block {
    int row = 0;        ///< its first row
    int tangents = -1;  ///< of a contact: 0 (frictionless), 2, or 3 with torsion; -1: a bounded row
    double mu = 0;      ///< of a contact
    /// equal for consecutive contacts of the same two bodies, which share their load evenly; -1:
    /// none
    int pair = -1;
    double low = 0,
           high = std::numeric_limits<double>::infinity();  ///< of a bounded row: low <= 0 <= high

    bool is_contact() const { return tangents >= 0; }
    int size() const { return is_contact() ? 1 + tangents : 1; }
  };
  /// symmetric, positive semidefinite: often singular [1/kg, for rotations 1/(kg m^2)]
  Eigen::MatrixXd W;
  Eigen::VectorXd q;          ///< velocities without impulses, minus their targets [m/s, rad/s]
  std::vector<Block> blocks;  ///< they cover the rows in order
};

/// Impulses and their residual.
struct FrictionSolution {
  Eigen::VectorXd r;  ///< impulses [N s, N m s]
  Eigen::VectorXd u;  ///< W r + q
  /// largest residual of any row, as a velocity; 0: exact (see friction_residual)
  double residual = 0;
  int iterations = 0;      ///< iterations of all methods together
  bool fell_back = false;  ///< did the fast methods fail to converge?
  bool solved = false;     ///< is the residual within the tolerance?
};

}  // namespace clench
