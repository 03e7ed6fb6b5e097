// One step as a problem of velocities: how everything would move without contacts, and the rows by
// which contacts, joint limits, motors and friction act on that.
#pragma once
#include <array>
#include <vector>

#include "clench/dynamics/control/motors.h"
#include "clench/dynamics/solve/friction_problem.h"

namespace clench {

/// A point where two bodies touch.
struct TouchingPoint {
  int manifold = 0, point = 0;  ///< among the world's manifolds, and among the points of that
  Id<Body> a, b;
  Eigen::Vector3d p_W = {};     ///< [m]
  Eigen::Matrix3d frame = {};   ///< columns: normal from a into b, two tangents; world
  Eigen::Vector3d belt_W = {};  ///< velocity of b's surface along itself, less that of a's [m/s]
  double torsion_radius = 0;    ///< of a soft contact [m]
  double target = 0;            ///< least velocity along the normal [m/s]
};

/// A contact or a coordinate row, with its place among the rows of the step and in its trees.
struct StepBlock {
  FrictionProblem::Block law;           ///< law.row: its first row in the step
  int touch = -1, coordinate_row = -1;  ///< its index there; the other is -1
  std::array<int, 2> tree = {-1, -1};   ///< that it acts on; -1: none
  std::array<int, 2> column = {0, 0};   ///< its first in the columns of each
  bool meets = false;                   ///< do the bodies approach each other when the step begins?
  double time = 0;                      ///< in which its impulse acts as a force [s]
};

/// How the rows of a step act on one tree.
struct TreeColumns {
  Eigen::MatrixXd Y;      ///< coordinates x rows: L^-1 J^T with the mass matrix L L^T
  std::vector<int> rows;  ///< of the step, by column; Y may have more columns
};

/// Trees that blocks connect, directly or through others; solved separately from all others.
struct Island {
  std::vector<int> blocks, trees;
};

/// Unknown are the velocities v = v_free + M^-1 J^T r and the impulses r, which obey the laws of the
/// blocks for u = J v - target. Vectors of rows have one entry per row of the step.
/// It keeps its memory from step to step, and nothing else.
struct StepProblem {
  double h = 0;                              ///< length of the step [s]
  std::vector<TreeDynamics> trees;           ///< where they stand; mass matrices are factored
  std::vector<JointForces> forces;           ///< by tree
  std::vector<Vector6d> root_accelerations;  ///< by tree; see TreeDynamics::root_acceleration
  Eigen::VectorXd v_before;  ///< of all coordinates, when the step begins [m/s, rad/s]
  Eigen::VectorXd v_free;    ///< when it ends, without impulses
  std::vector<TouchingPoint> touches;
  std::vector<CoordinateRow> coordinate_rows;
  std::vector<StepBlock> blocks;
  std::vector<TreeColumns> columns;  ///< by tree
  std::vector<double> q;             ///< J v_free less the target [m/s, rad/s]
  /// of q: what stabilization asks for, to open gaps that are too small and to bring joints back
  /// within their limits; where it contradicts other rows, it may be left out
  std::vector<double> push;
  std::vector<double> warm_start;  ///< impulses that the forces of the last step would give
  std::vector<double> compliance;  ///< on the diagonal of J M^-1 J^T
  std::vector<Island> islands;
  std::vector<double> tree_times;  ///< as the time of the blocks that act on it [s]

  int rows() const { return static_cast<int>(q.size()); }
};

struct StepSolution {
  Eigen::VectorXd v;  ///< of all coordinates, when the step ends [m/s, rad/s]
  Eigen::VectorXd r;  ///< impulses, by row [N s, N m s]
  int iterations = 0;
  int fallbacks = 0;    ///< islands that needed slow methods
  int failures = 0;     ///< islands without a solution
  double residual = 0;  ///< largest fault of a row [m/s, rad/s]
};

}  // namespace clench
