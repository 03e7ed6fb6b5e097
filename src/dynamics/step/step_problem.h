// One step as a problem of velocities: the motion without contacts, and the rows by which contacts,
// joint limits, motors and friction act on it.
#pragma once
#include <array>
#include <vector>

#include "clench/dynamics/control/motors.h"
#include "clench/dynamics/solve/friction_problem.h"

namespace clench {

/// A contact point of two bodies.
struct TouchingPoint {
  /// index of the manifold in the world, and of the point in the manifold
  int manifold = 0, point = 0;
  Id<Body> a, b;
  Eigen::Vector3d p_W = {};     ///< [m]
  Eigen::Matrix3d frame = {};   ///< columns: normal from a into b, two tangents; world
  Eigen::Vector3d belt_W = {};  ///< velocity of b's surface along itself, minus that of a's [m/s]
  double torsion_radius = 0;    ///< of a soft contact [m]
  double target = 0;            ///< minimum velocity along the normal [m/s]
};

/// A contact or a coordinate row, with its place among the rows of the step and of its trees.
struct StepBlock {
  FrictionProblem::Block law;           ///< law.row: its first row in the step
  int touch = -1, coordinate_row = -1;  ///< its index there; the other is -1
  std::array<int, 2> tree = {-1, -1};   ///< trees that it acts on; -1: none
  std::array<int, 2> column = {0, 0};   ///< its first column in each tree
  bool approaches = false;  ///< do the bodies approach each other at the start of the step?
  double time = 0;          ///< duration over which its impulse acts as a force [s]
};

/// Effect of the rows of a step on one tree.
struct TreeColumns {
  Eigen::MatrixXd Y;      ///< coordinates x rows: L^-1 J^T with the mass matrix L L^T
  std::vector<int> rows;  ///< rows of the step, by column; Y may have more columns
};

/// Trees connected by blocks, directly or through others; solved independently of all others.
struct Island {
  std::vector<int> blocks, trees;
};

/// The unknowns are the velocities v = v_free + M^-1 J^T r and the impulses r, which obey the laws
/// of the blocks for u = J v - target. Vectors of rows have one entry per row of the step.
/// Only its memory is kept between steps.
struct StepProblem {
  double h = 0;                              ///< length of the step [s]
  std::vector<TreeDynamics> trees;           ///< at their present poses; mass matrices are factored
  std::vector<JointForces> forces;           ///< by tree
  std::vector<Vector6d> root_accelerations;  ///< by tree; see TreeDynamics::root_acceleration
  Eigen::VectorXd v_before;  ///< of all coordinates, at the start of the step [m/s, rad/s]
  Eigen::VectorXd v_free;    ///< at its end, without impulses
  std::vector<TouchingPoint> touches;
  std::vector<CoordinateRow> coordinate_rows;
  std::vector<StepBlock> blocks;
  std::vector<TreeColumns> columns;  ///< by tree
  std::vector<double> q;             ///< J v_free minus the target [m/s, rad/s]
  /// part of q due to stabilization, which opens gaps that are too small and moves joints back
  /// within their limits; it may be omitted if it contradicts other rows
  std::vector<double> push;
  std::vector<double> warm_start;  ///< impulses corresponding to the forces of the last step
  std::vector<double> compliance;  ///< on the diagonal of J M^-1 J^T
  std::vector<Island> islands;
  std::vector<double> tree_times;  ///< duration over which its blocks act [s]

  int rows() const { return static_cast<int>(q.size()); }
};

struct StepSolution {
  Eigen::VectorXd v;  ///< of all coordinates, at the end of the step [m/s, rad/s]
  Eigen::VectorXd r;  ///< impulses, by row [N s, N m s]
  int iterations = 0;
  int fallbacks = 0;    ///< number of islands that needed slow methods
  int failures = 0;     ///< number of islands without a solution
  double residual = 0;  ///< largest residual of a row [m/s, rad/s]
};

}  // namespace clench
