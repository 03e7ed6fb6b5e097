// The step: bodies move with the velocities that they have, then contacts are found, then
// velocities are solved for.
// source  Stewart & Trinkle (1996), An implicit time-stepping scheme for rigid body dynamics with
//         inelastic collisions and Coulomb friction; de Saxce & Feng (1998) for the cone; Anitescu
//         & Hart (2004) for gaps in the right-hand side
#pragma once
#include <array>

#include "clench/base/disjoint_sets.h"
#include "clench/dynamics/contact/manifolds.h"
#include "clench/dynamics/control/motors.h"
#include "clench/dynamics/mover.h"
#include "clench/dynamics/solve/solve_friction.h"
#include "clench/dynamics/tree/tree_dynamics.h"

namespace clench {

/// Steps a world. Holds only scratch memory; all state is in the World, so a new Stepper continues
/// bit-exactly. A step that is stopped (see base/watched.h) throws Stopped; a step that throws leaves
/// the world bit-exactly as it was before.
class Stepper {
 public:
  explicit Stepper(World& world);

  /// Moves everything by its velocity until dt has passed [s] or two bodies that approach each
  /// other touch.
  /// returns  the time that has passed, in (0, dt] [s]
  double move(double dt);
  /// Velocities that forces, contacts, limits and motors leave after a time of h [s] in which they
  /// act.
  void solve(double h);
  /// One step of a run that ends at a time [s].   returns  false when it is over, and no step was
  /// made
  bool step(double end);
  /// Steps until exactly `duration` has passed [s].
  void run(double duration);

 private:
  struct TouchingPoint {  // a point of a manifold
    int manifold, point;
    Eigen::Matrix3d frame;  // columns: normal, tangents; world
    Eigen::Vector3d p_W;
    Id<Body> a, b;
    double target = 0;  // lowest velocity along the normal
  };
  /// A contact or a row of a coordinate, and where its rows stand.
  struct PlacedBlock {
    FrictionProblem::Block law;
    int touch = -1, row = -1;            // one of both
    std::array<int, 2> tree = {-1, -1};  // that it acts on
    std::array<int, 2> column = {0, 0};  // its first, in the tree's J
    bool meets = false;                  // bodies that come together in this step
    double time = 0;                     // in which its impulse acts as a force [s]
  };
  struct TreeRows {
    Eigen::MatrixXd Y;      // L^-1 J^T: coordinates x rows
    std::vector<int> rows;  // of all, by column
  };
  /// Bodies that touch, directly or through others; solved separately from other islands.
  struct Island {
    std::vector<int> blocks, trees;
  };

  void refresh();
  double move_bodies(double dt);
  void solve_found(double h);  // the manifolds are those of the bodies where they are
  double max_travel(double dt) const;
  double advance_balls(const std::vector<std::pair<int, double>>& pairs, double end, Mover& mover);
  double free_until(const Manifold& m, int places, double dt, Mover& mover);
  struct Meetings;
  void follow_pair(int number, double dt, Mover& mover, Meetings& meetings);
  double time_until_meeting(Meetings& meetings, double dt, Mover& mover);
  void measure_met(Meetings& meetings, bool whole);
  Vector6d root_twist(int tree) const;
  Eigen::Vector3d prescribed_velocity(Id<Body> body, const Eigen::Vector3d& p_W) const;
  Eigen::Vector3d prescribed_turning(Id<Body> body) const;
  Eigen::Vector3d surface_velocity(Id<Body> body) const;
  void carry_welded();
  void find_free_velocities(double h);
  bool whirls(int tree, double h) const;
  void add_mean_bias(int tree, double h, Eigen::VectorXd& change);
  void update_manifolds();
  Eigen::Matrix3d frame_of(const Manifold& m, int manifold, const ManifoldPoint& p) const;
  void add_contact_columns(const TouchingPoint& touch, double torsion_radius, PlacedBlock& block);
  std::array<double, 4> add_free_velocities(const TouchingPoint& touch, double torsion_radius,
                                            const PlacedBlock& block);
  void add_contact(int manifold, int point, double h);
  void add_row(int row, double h);
  int add_columns(int tree, int count);
  void find_rows(double h);
  void find_islands();
  bool holds(const Island& island, const Eigen::VectorXd& warm, FrictionSolution& solution,
             double h);
  void assemble(const Island& island, int count);
  void solve_island(const Island& island, double h);
  void apply_impulses(double h);
  void solve_by_ode(double h);
  void find_times(double h);
  void keep();
  void disengage();

  World& world_;
  System system_;
  uint64_t stamp_ = 0, settings_stamp_ = 0;
  std::vector<unsigned char> follows_;
  std::vector<TreeDynamics> trees_;
  std::vector<JointForces> forces_;
  std::vector<TreeRows> tree_rows_;
  std::vector<CoordinateRow> coordinate_rows_;
  std::vector<TouchingPoint> touches_;
  std::vector<PlacedBlock> blocks_;
  std::vector<Island> islands_;
  DisjointSets touching_trees_;
  std::vector<int> island_of_;  // by tree
  Eigen::VectorXd v_, v_before_, r_, compliance_;
  std::vector<int> rows_;   // of the island that is solved
  std::vector<int> local_;  // of all rows: which one of its island's problem it is
  std::vector<double> q_, warm_;
  std::vector<bool> resting_;
  std::vector<double> tree_times_;  // as of the blocks that act on it [s]
  int row_count_ = 0;
  FrictionSolver solver_;
  FrictionProblem problem_;
};

}  // namespace clench
