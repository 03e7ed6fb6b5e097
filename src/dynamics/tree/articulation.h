// Which bodies move together: robots with all that they carry, and free bodies with what is welded
// to them, each as a tree of joints with coordinates of its own. Joints cannot drift apart, since
// nothing but the coordinates is integrated.
#pragma once
#include <vector>

#include "clench/model/world.h"

namespace clench {

/// A joint of the tree. Its velocity is ratio times that of a coordinate: joints that one DOF turns
/// share one.
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
  int joint = -1;  ///< that moves it, with all before; -1: it is fixed to the root
  bool welded = false;
};

/// Owner of a velocity: a DOF whose joints follow it, or a joint that has left its DOF.
struct Coordinate {
  Id<Robot> robot;
  int dof = -1;                           ///< of the robot
  int joint = -1;                         ///< of the robot; -1: the DOF's
  size_t dof_index = 0, joint_index = 0;  ///< in the state's arrays
};

struct Articulation {
  /// six coordinates first: the root's velocity at centre(), and its turning
  bool floating = false;
  Id<Body> root;  ///< a free body or the base of a robot that nobody carries
  std::vector<ArticulationJoint> joints;
  std::vector<TreeBody> bodies;         ///< the root first
  std::vector<Coordinate> coordinates;  ///< without the six
  std::vector<Id<Robot>> robots;
  int first = 0;  ///< of its coordinates, in the system's vectors

  int root_size() const { return floating ? 6 : 0; }
  int size() const { return root_size() + static_cast<int>(coordinates.size()); }
  /// is it one rigid piece?
  bool is_free_body() const { return floating && joints.empty(); }
};

/// All that can move of its own in a world; obstacles and standing bases are the ground.
struct System {
  std::vector<Articulation> trees;
  struct Place {
    int tree = -1;  ///< -1: the ground, which moves as it is told
    int body = -1;  ///< of the tree
  };
  std::vector<Place> places;  ///< by the index of the body's id
  /// objects and what carries them, carriers first
  std::vector<std::pair<Id<Body>, Id<Body>>> welds;
  int size = 0;

  Place place(Id<Body> id) const { return places[id.index]; }
};

System find_system(const World& world);

/// The point of the root whose velocity counts: its centre of mass; that of all that is welded to
/// it, where nothing has joints [m].
Eigen::Vector3d centre(const World& world, const Articulation& tree);

/// How the six coordinates of a root that floats move the origin of its frame, and turn it:
/// (velocity, angular velocity) = J v, in world axes.
Eigen::Matrix<double, 6, 6> free_motion(const World& world, const Articulation& tree);

/// Of a root that moves as prescribed, at centre() [m/s, rad/s]; 0 of one that floats, whose
/// velocity is in the coordinates.
Vector6d prescribed_twist(const World& world, const Articulation& tree);

/// Velocities of all coordinates, as the world's state has them.
void gather_velocities(const System& system, const World& world, const DynamicState& state,
                       Eigen::VectorXd& v);
/// The other way round; joints that follow a DOF get theirs.
void scatter_velocities(const System& system, const World& world, const Eigen::VectorXd& v,
                        DynamicState& state);

}  // namespace clench
