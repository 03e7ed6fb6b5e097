// A robot as files of today describe it: a tree of links, joints between them that stand anywhere.
// URDF and MJCF become this, whose joints may follow each other; make_robot makes ours of it.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clench/io/text/find_file.h"
#include "clench/spec/robot_spec.h"

namespace clench {

/// A joint as its file gives it: q = ratio * leader + offset when it follows another. Its axis
/// stands in the frame before it.
struct TreeJoint : JointSpec {
  Place place;                                       ///< hand.urdf:31
  DofSpec motor;                                     ///< what a leader's DOF becomes
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  ///< a point of the axis [m]
  double zero = 0;                                   ///< q at which it changes no pose [rad or m]
  /// time constant [s] and damping ratio from which spring and damping are to follow
  std::optional<std::array<double, 2>> spring_damper = {};
  int leader = -1;  ///< index into joints; -1: a DOF of its own
};

/// frame = parent's frame * X_PL * joints, in their order
struct TreeLink {
  BodySpec body;
  int parent = -1;  ///< index into links, less than its own; -1: the root
  Pose X_PL;
  std::vector<int> joints;
};

struct TreeModel {
  std::string name, class_name;
  std::vector<TreeLink> links;  ///< [0] is the root, and becomes the base
  std::vector<TreeJoint> joints;
  std::vector<ActuatorSpec> actuators;  ///< `dof`: the joint that each moves
  /// does its file list actuators? then joints that none drives do not close
  bool has_actuators = false;
  std::vector<JointTendonSpec> tendons;          ///< `arms`: of joints that lead
  std::vector<std::pair<int, int>> never_meet;   ///< links whose collisions the file switches off
  std::vector<std::pair<int, int>> always_meet;  ///< neighbors that collide all the same
};

/// How far searches go from where a joint without limits is: a full turn [rad]; so far [m].
inline constexpr double endless_turn = 6.283185307179586, endless_slide = 1;

/// In a URDF, which has no word for none, a limit of effort or velocity, or of where a joint
/// slides, that we write, and read, as none [N m, N, rad/s, m/s or m]. Other readers take 0 for a
/// joint that cannot move.
inline constexpr double unlimited = 1e9;

/// Frame after a joint at q, in the frame before it.
Pose joint_pose(const TreeJoint& joint, double q);

/// Makes leaders of leaders one step long, so that every leader is a DOF.
/// throws  Error "hand.urdf:31: joint 'a' follows itself by way of 'b'"
void resolve_leaders(TreeModel& tree);

/// Orders branches so that of the joints of a DOF one comes first that slides or turns as the
/// leader does: by its first joint a DOF counts in lengths or angles. A leader behind its follower
/// in one branch stays there.   `tree`  each link after its parent, leaders resolved
void order_branches(TreeModel& tree);

}  // namespace clench
