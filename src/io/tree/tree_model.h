// A robot in the form used by URDF and MJCF: a tree of links, connected by joints at any pose,
// which may follow each other. The readers build this model, and make_robot converts it to a
// RobotSpec.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clench/io/text/find_file.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// A joint as given by its file; if it follows another, q = ratio * leader + offset. Its axis is
/// expressed in the frame before it.
struct TreeJoint : JointSpec {
  Place place;                                       ///< hand.urdf:31
  DofSpec motor;                                     ///< settings of the DOF, for leaders
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  ///< a point of the axis [m]
  double zero = 0;                                   ///< q at which it changes no pose [rad or m]
  /// time constant [s] and damping ratio, from which spring and damping are computed
  std::optional<std::array<double, 2>> spring_damper = {};
  int leader = -1;  ///< index into joints; -1: a separate DOF
};

/// frame = parent's frame * X_PL * joints, in order
struct TreeLink {
  BodySpec body;
  int parent = -1;  ///< index into links, less than that of this link; -1: the root
  Pose X_PL;
  std::vector<int> joints;
};

struct TreeModel {
  std::string name, class_name;
  std::vector<TreeLink> links;  ///< [0] is the root, and becomes the base
  std::vector<TreeJoint> joints;
  std::vector<ActuatorSpec> actuators;  ///< `dof`: index of the joint that each moves
  /// true if the file lists actuators; then joints that none drives do not close
  bool has_actuators = false;
  std::vector<JointTendonSpec> tendons;          ///< `arms`: of joints that are leaders
  std::vector<std::pair<int, int>> never_meet;   ///< links whose collisions the file disables
  std::vector<std::pair<int, int>> always_meet;  ///< neighbors that collide nevertheless
};

/// Search range of joints without limits, from the current value: a full turn [rad]; this length
/// [m].
inline constexpr double endless_turn = 6.283185307179586, endless_slide = 1;

/// Represents "no limit" in a URDF, which cannot express it, for effort, velocity and the range of
/// slides [N m, N, rad/s, m/s or m]. Other readers treat 0 as a joint that cannot move.
inline constexpr double unlimited = 1e9;

/// Frame after a joint at q, in the frame before it.
Pose joint_pose(const TreeJoint& joint, double q);

/// Resolves leaders that follow others, so that every leader is a DOF.
/// throws  Error "hand.urdf:31: joint 'a' follows itself via 'b'"
void resolve_leaders(TreeModel& tree);

/// The first joint of a DOF determines whether its unit is a length or an angle. Reorders branches
/// so that the first joint is of the same kind as the leader, unless the leader is distal to it in
/// the same branch.   `tree`  each link after its parent, leaders resolved
void order_branches(TreeModel& tree);

}  // namespace clench
