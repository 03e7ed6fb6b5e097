// A world as the tree of MJCF bodies to be written: names, joints and current poses.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "clench/spec/chains.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// A joint of a body; anchor [m] and axis in the body's frame at its current pose.
struct WrittenJoint {
  std::string name;
  const JointSpec* spec = nullptr;
  int robot = 0, number = 0;  ///< index among the robot's joints, link by link
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::UnitZ();
  double value = 0;  ///< current q [rad or m]

  /// The joint's coordinate in the robot's file and in the scene, for its position q [rad or m].
  double coordinate(double q) const { return q + spec->offset; }
};

struct WrittenBody {
  std::string name;
  const BodySpec* spec = nullptr;
  int parent = -1;  ///< index of a body; -1: the world
  Pose X_WB;
  bool free = false;          ///< moves freely, by a free joint
  bool carried = false;       ///< mounted on a carriage, see SceneRequest
  int body = -1;              ///< index of a body in the world; -1: a part of a robot
  int robot = -1, link = -1;  ///< index of a robot in the world, and of its link; -1: the base
  std::vector<WrittenJoint> joints = {};
  std::vector<int> children = {};

  bool is_movable() const { return free || carried || !joints.empty(); }
};

/// Static and kinetic coefficient of two materials.
using FrictionOf = std::function<std::array<double, 2>(const std::string&, const std::string&)>;

/// A keyframe of a scene.
struct WrittenKey {
  std::string name;
  std::vector<Pose> bodies;                 ///< one per body of the world
  std::vector<Pose> robots;                 ///< base of each robot
  std::vector<std::vector<double>> joints;  ///< per robot [rad or m]
  /// per robot and DOF, in addition to the efforts that hold the posture [N m or N]; empty: none
  std::vector<std::vector<double>> efforts = {};
  /// per robot, target positions of the servos of joints [rad or m]; empty: `joints`
  std::vector<std::vector<double>> targets = {};
};

struct SceneRequest {
  const WorldSpec& world;
  FrictionOf friction;
  std::string name = "scene";
  std::vector<WrittenKey> keys = {};
  /// robot whose base moves on three slides along the world's axes, and on three hinges if keys
  /// turn it; -1: none
  int carriage = -1;
  double time_step = 0.001;           ///< [s]
  std::vector<int> unsupported = {};  ///< robots whose motors do not compensate their weight
  /// radius of torsional friction between soft bodies [m]; 0: not known
  double torsion_radius = 0;
};

/// Bodies in depth-first order, as numbered by MuJoCo.
struct WrittenScene {
  std::vector<WrittenBody> bodies;
  std::vector<int> roots;
  std::vector<std::vector<int>> parts;  ///< per robot, indices of its base and links in `bodies`

  const WrittenBody& part(int robot, int link) const {
    return bodies[static_cast<size_t>(
        parts[static_cast<size_t>(robot)][static_cast<size_t>(link + 1)])];
  }
  /// True if it is this body, or is attached to it.
  bool is_below(int body, int ancestor) const;
  /// True if it is fixed to the world.
  bool stands(int body) const;
};

WrittenScene plan_scene(const SceneRequest& request);

/// A joint moved by a DOF of its robot, and the body that the joint moves.
struct MovedBody {
  int body = 0;
  const WrittenJoint* joint = nullptr;
};
/// Joints of a DOF, link by link. A joint with the value of the DOF, or otherwise with its opposite
/// value, is moved to the front.
std::vector<MovedBody> joints_of_dof(const WrittenScene& scene, int robot, int dof);

/// Inertia and weight that a DOF moves at the current posture.
struct DofLoad {
  double inertia = 0;  ///< [kg m^2 or kg]
  double weight = 0;   ///< effort of gravity on the DOF [N m or N]
};
DofLoad load_of_dof(const WrittenScene& scene, const std::vector<MovedBody>& joints,
                    const Eigen::Vector3d& gravity);

/// `name`, or `name_2` and so on if `taken` contains it already; adds the result to `taken`.
std::string unique_name(const std::string& name, std::vector<std::string>& taken);

}  // namespace clench
