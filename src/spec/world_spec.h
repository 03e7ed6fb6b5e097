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

/// A joint's own position, which its DOF does not tell: it has broken away from a breakaway DOF, or
/// is held against its spring by what a compliant finger touches. None while it follows its DOF
/// [rad or m].
using JointPosition = std::optional<double>;

struct PlacedRobot {
  RobotSpec robot;
  Pose X_WB;
  std::vector<double> dofs;  ///< one per DOF [rad or m]
  /// one per joint, link by link; empty: all follow their DOFs
  std::vector<JointPosition> joint_positions;
  bool floating = false;  ///< does its base move freely? else it stands
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

/// One entry of the file's order, so that bodies keep their numbering.
struct WorldEntry {
  enum class Kind { body, robot, connection } kind;
  int index;  ///< into bodies, robots or connections
};

/// Friction of a pair of materials, new ones or of another coefficient than every world begins
/// with.
struct FrictionSpec {
  std::string a, b;
  double statics = 0, kinetic = 0;
  std::optional<double> restitution = {};
};

/// A body, or a base or link of a robot.
struct PartRef {
  WorldEntry::Kind kind = WorldEntry::Kind::body;  ///< body or robot
  int index = 0;                                   ///< into bodies or robots
  int link = -1;                                   ///< of the robot; -1: its base
};

/// Bits of a body or a part of a robot. Two parts with bits that are not of one robot collide only
/// if the type of one and the affinity of the other share a bit, and if not both are fixed.
struct CollisionBits {
  unsigned type = 1, affinity = 1;
  bool stands = false;  ///< fixed to the world

  bool keeps_apart(const CollisionBits& other) const {
    return (stands && other.stands) || !((type & other.affinity) || (other.type & affinity));
  }
  bool operator==(const CollisionBits&) const = default;
};

/// Collisions that are switched off, and bits, by the names of bodies.
struct CollisionSpec {
  bool on = true;  ///< false: nothing collides
  std::vector<std::string> bodies_off;
  std::vector<std::array<std::string, 2>> pairs_off;
  std::vector<std::pair<std::string, CollisionBits>> bits;
  std::vector<std::array<std::string, 2>> pairs_on;  ///< they collide whatever their bits are
};

/// A state of a world by its name: what stands where then. What it does not name stays as it is.
template <class BodyRef, class RobotRef>
struct KeyframeOf {
  struct PlacedBody {
    BodyRef body;
    Pose X_WB;
  };
  struct PlacedRobot {
    RobotRef robot;
    std::optional<Pose> X_WB;  ///< of its base; absent: it is carried
    std::vector<double> dofs;  ///< one per DOF, within the limits [rad or m]
  };
  std::string name;
  std::vector<PlacedBody> bodies;
  std::vector<PlacedRobot> robots;
};
using KeyframeSpec = KeyframeOf<int, int>;  ///< indices into bodies and robots

inline constexpr double standard_gravity = 9.81;  ///< as simulators have it [m/s^2]

struct WorldSpec {
  std::string source;
  std::vector<PlacedBody> bodies;
  std::vector<PlacedRobot> robots;
  std::vector<WorldEntry> order;  ///< connections that are not named come last
  std::vector<Connection> connections;
  std::optional<Camera> camera;
  std::optional<double> contact_threshold;  ///< [m]; absent: that of an empty world
  std::optional<double> time_step;          ///< of dynamics [s]; absent: that of an empty world
  std::vector<FrictionSpec> friction;       ///< in the order in which new materials get their names
  std::vector<OwnFriction> frictions;       ///< of further materials, named by material_name()
  std::optional<CollisionSpec> collision;   ///< absent: what the robots bring along
  std::vector<std::array<PartRef, 2>> never_meet;  ///< beside what the robots bring along
  /// pairs of which one part has no bits may collide
  std::vector<std::pair<PartRef, CollisionBits>> collision_bits;
  std::vector<std::array<PartRef, 2>> always_meet;  ///< whatever their bits are
  bool collision_on = true;                         ///< false: nothing collides
  /// in the world frame [m/s^2]; absent: standard_gravity along -z
  std::optional<Eigen::Vector3d> gravity;
  std::vector<KeyframeSpec> keyframes;
};

}  // namespace clench
