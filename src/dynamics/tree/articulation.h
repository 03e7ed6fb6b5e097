// Groups of bodies that move together: robots with all bodies that they carry, and free bodies with
// those welded to them, each as a tree of joints with separate coordinates. Joints cannot drift
// apart, because only the coordinates are integrated.
#pragma once
#include <vector>

#include "clench/model/world.h"

namespace clench {

/// A joint of the tree. Its velocity is ratio times that of a coordinate: joints driven by one DOF
/// share a coordinate.
struct ArticulationJoint {
  Id<Robot> robot;
  int joint = 0;       ///< of the robot
  int parent = -1;     ///< an earlier joint of the tree; -1: the root
  int coordinate = 0;  ///< of the tree
  double ratio = 1;
  bool slides = false;
};

struct TreeBody {
  Id<Body> body;
  int joint = -1;  ///< the joint that moves it, after all earlier ones; -1: it is fixed to the root
  bool welded = false;
};

/// Owner of a velocity: a DOF whose joints follow it, or a joint that has left its DOF.
struct Coordinate {
  Id<Robot> robot;
  int dof = -1;                           ///< of the robot
  int joint = -1;                         ///< of the robot; -1: the velocity is the DOF's
  size_t dof_index = 0, joint_index = 0;  ///< in the state's arrays
};

struct Articulation {
  /// six coordinates first: the linear velocity of the root at center(), and its angular velocity
  bool floating = false;
  Id<Body> root;  ///< a free body, or the base of a robot that nothing carries
  std::vector<ArticulationJoint> joints;
  std::vector<TreeBody> bodies;         ///< the root first
  std::vector<Coordinate> coordinates;  ///< without the six of the root
  std::vector<Id<Robot>> robots;
  int first = 0;  ///< index of its first coordinate in the system's vectors

  int root_size() const { return floating ? 6 : 0; }
  int size() const { return root_size() + static_cast<int>(coordinates.size()); }
  /// is it one rigid piece?
  bool is_free_body() const { return floating && joints.empty(); }
};

/// All bodies that can move in a world; obstacles and fixed bases belong to the ground.
struct System {
  std::vector<Articulation> trees;
  struct Place {
    int tree = -1;  ///< -1: the ground, whose motion is prescribed
    int body = -1;  ///< of the tree
  };
  std::vector<Place> places;  ///< by the index of the body's id
  /// objects and their carriers, carriers first
  std::vector<std::pair<Id<Body>, Id<Body>>> welds;
  int size = 0;

  Place place(Id<Body> id) const { return places[id.index]; }
};

System find_system(const World& world);

/// Reference point of the root: its center of mass; that of the complete rigid piece if the tree
/// has no joints [m].
Eigen::Vector3d center(const World& world, const Articulation& tree);

/// How the six coordinates of a floating root move the origin of its frame, and rotate it:
/// (velocity, angular velocity) = J v, in world axes.
Eigen::Matrix<double, 6, 6> free_motion(const World& world, const Articulation& tree);

/// Velocity of a root with prescribed motion, at center() [m/s, rad/s]; 0 for a floating root,
/// whose velocity is in the coordinates.
Vector6d prescribed_twist(const World& world, const Articulation& tree);

/// Velocities of all coordinates, read from the world's state.
void gather_velocities(const System& system, const World& world, const DynamicState& state,
                       Eigen::VectorXd& v);
/// The inverse: writes them to the state; joints that follow a DOF get its velocity times their
/// ratio.
void scatter_velocities(const System& system, const World& world, const Eigen::VectorXd& v,
                        DynamicState& state);

}  // namespace clench
