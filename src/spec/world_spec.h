// A world as a file describes it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "clench/spec/robot_spec.h"

namespace clench {

enum class Role { object, obstacle };

struct PlacedBody {
  BodySpec body;
  Role role = Role::object;
  Pose X_WB;
};

/// A joint's own position, independent of its DOF: it has left a breakaway DOF, or contact of a
/// compliant finger holds it against its spring. Empty while it follows its DOF [rad or m].
using JointPosition = std::optional<double>;

struct PlacedRobot {
  RobotSpec robot;
  Pose X_WB;
  std::vector<double> dofs;  ///< one per DOF [rad or m]
  /// one per joint, link by link; empty: all follow their DOFs
  std::vector<JointPosition> joint_positions;
  bool floating = false;  ///< does its base move freely? otherwise it is fixed
};

/// The child's base is fixed to a link of the parent.
struct Connection {
  int parent = 0;  ///< index into WorldSpec::robots
  int link = 0;    ///< of the parent
  int child = 0;
  Pose X_LB;                      ///< child base in the parent's link
  std::optional<BodySpec> mount;  ///< adapter piece, at the link's frame
};

struct Camera {
  Pose X_WC;                    ///< looks along -z, y up
  double focal_distance = 0.1;  ///< [m]
};

/// throws Error  "camera: focal distance: expected a number from 1e-12 to 1e+09 [m], got -1"
void check_camera(const Camera& camera, std::string_view subject = "camera");

/// One entry of the file's order, which determines the numbering of bodies.
struct WorldEntry {
  enum class Kind { body, robot, connection } kind;
  int index;  ///< into bodies, robots or connections
};

/// Friction of a pair of materials that differs from the predefined one.
struct FrictionSpec {
  std::string a, b;
  double statics = 0, kinetic = 0;
  std::optional<double> restitution = {};
};

/// A body, or a base or link of a robot.
struct PartRef {
  WorldEntry::Kind kind = WorldEntry::Kind::body;  ///< body or robot
  int index = 0;                                   ///< index into bodies or robots
  int link = -1;                                   ///< of the robot; -1: its base
};

/// Collision bits of a body or a part of a robot. Two parts with bits that do not belong to one
/// robot collide only if the type of one and the affinity of the other share a bit, and if not both
/// are fixed.
struct CollisionBits {
  unsigned type = 1, affinity = 1;
  bool stands = false;  ///< fixed to the world

  bool keeps_apart(const CollisionBits& other) const {
    return (stands && other.stands) || !((type & other.affinity) || (other.type & affinity));
  }
  bool operator==(const CollisionBits&) const = default;
};

/// Disabled collisions, and bits, by the names of bodies.
struct CollisionSpec {
  bool on = true;  ///< false: nothing collides
  std::vector<std::string> bodies_off;
  std::vector<std::array<std::string, 2>> pairs_off;
  std::vector<std::pair<std::string, CollisionBits>> bits;
  std::vector<std::array<std::string, 2>> pairs_on;  ///< they collide whatever their bits
};

/// A named state of a world: poses and DOFs of some of its bodies. The others are unchanged.
template <class BodyRef, class RobotRef>
struct KeyframeOf {
  struct PlacedBody {
    BodyRef body;
    Pose X_WB;
  };
  struct PlacedRobot {
    RobotRef robot;
    std::optional<Pose> X_WB;  ///< of its base; absent: another robot carries it
    std::vector<double> dofs;  ///< one per DOF, within the limits [rad or m]
  };
  std::string name;
  std::vector<PlacedBody> bodies;
  std::vector<PlacedRobot> robots;
};
using KeyframeSpec = KeyframeOf<int, int>;  ///< indices into bodies and robots

inline constexpr double standard_gravity = 9.81;  ///< given to the simulator [m/s^2]

struct WorldSpec {
  std::string source;
  std::vector<PlacedBody> bodies;
  std::vector<PlacedRobot> robots;
  std::vector<WorldEntry> order;  ///< unnamed connections come last
  std::vector<Connection> connections;
  std::optional<Camera> camera;
  std::optional<double> contact_threshold;  ///< [m]; absent: the default of a new world
  std::optional<double> time_step;          ///< of dynamics [s]; absent: the default of a new world
  std::vector<FrictionSpec> friction;       ///< in the order in which new materials are added
  std::vector<OwnFriction> frictions;       ///< of further materials, named by material_name()
  std::optional<CollisionSpec> collision;   ///< absent: given by the robots
  std::vector<std::array<PartRef, 2>> never_meet;  ///< in addition to those of the robots
  /// a part that is not listed may collide with all others
  std::vector<std::pair<PartRef, CollisionBits>> collision_bits;
  std::vector<std::array<PartRef, 2>> always_meet;  ///< whatever their bits
  bool collision_on = true;                         ///< false: nothing collides
  /// in the world frame [m/s^2]; absent: standard_gravity along -z
  std::optional<Eigen::Vector3d> gravity;
  std::vector<KeyframeSpec> keyframes;
};

}  // namespace clench
