// Masses and forces of an articulated system in its coordinates.
// source  Featherstone (2008), Rigid Body Dynamics Algorithms: recursive Newton-Euler (5.3),
//         composite rigid bodies (6.2). All spatial vectors are (linear, angular) in world axes
//         about one point, so nothing is transformed on the way
#pragma once
#include <vector>

#include "clench/dynamics/tree/articulation.h"
#include "clench/math/pose.h"

namespace clench {

/// Inertia of one or several rigid bodies, about a point, in world axes.
struct SpatialInertia {
  double mass = 0;
  /// mass times the vector from the point to the center of mass [kg m]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turning = Eigen::Matrix3d::Zero();  ///< about the point [kg m^2]

  static SpatialInertia of(const Body& body, const Pose& X_WB, const Eigen::Vector3d& about);
  void add(const SpatialInertia& other) {
    mass += other.mass;
    moment += other.moment;
    turning += other.turning;
  }
  /// momentum of a twist
  Vector6d operator*(const Vector6d& motion) const;
};

/// One tree at its present pose; kept between steps so that nothing is allocated.
class TreeDynamics {
 public:
  /// Computes poses of joints and masses, and the mass matrix.
  void place(const World& world, const Articulation& tree);
  /// Velocity-dependent and gravitational forces on each coordinate: M dv/dt = efforts - bias. A
  /// floating root is assumed to conserve the momentum of its tree while it moves (see
  /// root_velocity): its bias is weight alone, and dv/dt lacks the acceleration of the root that
  /// this causes.
  /// root_twist  of a root with prescribed motion, at the point about() [m/s, rad/s]
  /// gravity     [m/s^2]
  /// returns     bias, one per coordinate [N or N m]
  const Eigen::VectorXd& find_bias(const Eigen::VectorXd& v, const Vector6d& root_twist,
                                   const Eigen::Vector3d& gravity);
  /// Acceleration of a floating root that the last find_bias omitted; otherwise 0.
  const Vector6d& root_acceleration() const { return coasting_; }
  /// Efforts on each joint, in addition to forces on bodies, that produce given changes of
  /// velocity. Recursive Newton-Euler.
  /// change  of the coordinates' velocities, as find_bias has them [m/s^2, rad/s^2]
  /// loads   on the bodies, (force, torque about about()), by the tree's bodies; or none
  /// returns one per joint of the tree, for its own unit [N m or N]
  const std::vector<double>& inverse_dynamics(const Eigen::VectorXd& v,
                                              const Eigen::VectorXd& change,
                                              const Vector6d& root_twist,
                                              const Eigen::Vector3d& gravity,
                                              const std::vector<Vector6d>& loads);
  /// Efforts on each coordinate that carry the weight of all that it moves, minus the weight of
  /// welded objects [N m or N].
  Eigen::VectorXd weight(const World& world) const;
  /// Impulses on the coordinates when the velocity of a base with prescribed motion jumps.
  Eigen::VectorXd base_impulse(const Vector6d& change_of_root) const;
  /// Momentum of a tree with a floating root: linear, and angular about about() [N s, N m s].
  /// v  of its coordinates alone
  Vector6d momentum(const Eigen::Ref<const Eigen::VectorXd>& v) const;
  /// Velocity of a floating root that gives its tree a momentum.
  /// v  of its coordinates alone; those of the root are not used
  Vector6d root_velocity(const Vector6d& momentum,
                         const Eigen::Ref<const Eigen::VectorXd>& v) const;
  /// Adds mass-like terms to the diagonal (armature; damping h d and springs h^2 k, taken at the
  /// end of the step), and factors the matrix.
  /// added_to_root  6 x 6, likewise for a floating root; or empty
  void factor(const Eigen::VectorXd& added_to_diagonal, const Eigen::MatrixXd& added_to_root = {});

  const Eigen::MatrixXd& mass_matrix() const { return M_; }
  const Eigen::Vector3d& about() const { return about_; }
  /// Y = L^-1 B with M = L L^T, in place.   B  coordinates x any
  void half_solve(Eigen::Ref<Eigen::MatrixXd> B) const;
  /// x = L^-T x, in place
  void other_half_solve(Eigen::Ref<Eigen::VectorXd> x) const;

  /// How coordinates move a point of a body: adds sign * direction . velocity to a column; the
  /// second function adds the body's angular velocity.
  void add_linear(int body, const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction,
                  double sign, Eigen::Ref<Eigen::VectorXd> column) const;
  void add_angular(int body, const Eigen::Vector3d& direction, double sign,
                   Eigen::Ref<Eigen::VectorXd> column) const;
  /// Velocity of its center of mass.
  Twist twist(int body, const Eigen::Ref<const Eigen::VectorXd>& v,
              const Vector6d& root_twist) const;
  const Eigen::Vector3d& com(int body) const { return com_[body]; }

 private:
  // spatial velocity of a body at about()
  Vector6d motion(int body, const Eigen::Ref<const Eigen::VectorXd>& v,
                  const Vector6d& root_twist) const;
  void place_joints(const World& world);
  void find_mass_matrix();
  void add_bias(const Eigen::VectorXd& v, const Vector6d& root_twist,
                const Eigen::Vector3d& gravity);
  Vector6d coasting_acceleration(const Vector6d& bias) const;
  void find_forces(const Eigen::VectorXd& v, const Eigen::VectorXd* change,
                   const Vector6d& root_twist, const Eigen::Vector3d& gravity);

  const Articulation* tree_ = nullptr;
  Eigen::Vector3d about_ = Eigen::Vector3d::Zero();
  std::vector<Vector6d> S_;           // by joint, for its own unit speed
  std::vector<Eigen::Vector3d> com_;  // by body
  std::vector<SpatialInertia> own_,
      all_;  // by joint + 1, the root first: of what it carries directly, and of everything beyond
  std::vector<Vector6d> velocity_, acceleration_, force_;
  std::vector<double> joint_efforts_;
  Eigen::MatrixXd M_, L_;
  // does a free body's added mass couple its linear and angular velocity?
  bool root_is_coupled_ = false;
  std::vector<SpatialInertia> carried_;  // as own_, for the weight that is left out; or empty
  Eigen::VectorXd bias_;
  Vector6d coasting_ = Vector6d::Zero();
  RobotFrames frames_;
};

}  // namespace clench
