// A robot as a hand: its palm, and the fingers attached to it.
//
// Fingers are the links at the ends of the tree that are separated from the palm by joints; the
// palm is the last link common to all of them. A single finger of one or two joints closes against
// its carrier; a longer one is an arm, and has no fingers.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

struct Finger {
  int tip = 0;             ///< link
  std::vector<int> links;  ///< joints between palm and tip, from the palm on, and the tip
  Eigen::Vector3d p_tip;   ///< in the tip's frame
};

/// Values of all DOFs, and the resulting poses of the links in the base's frame.
struct Posture {
  std::vector<double> q;
  std::vector<Pose> poses;

  Pose at(int link) const { return link < 0 ? Pose{} : poses[link]; }
};

struct HandTree {
  const RobotSpec& robot;
  int palm = -1;
  std::vector<Finger> fingers;
  std::vector<int> dofs;                      ///< joints that can move
  Posture rest;                               ///< initially
  std::vector<std::array<double, 2>> ranges;  ///< one per DOF

  /// Does the DOF turn without limits?
  bool turns_without_end(int dof) const;
};

HandTree hand_tree(const RobotSpec& robot);

const BodySpec& body_of(const RobotSpec& robot, int link);
/// Its visible shape: its geometry or, without any, the surface that is drawn; may be null.
const ShapePtr& drawn(const BodySpec& body);
/// Joints of the links between an ancestor (excluded) and a link (included).
std::vector<const JointSpec*> joints_below(const RobotSpec& robot, int ancestor, int link);
/// Fingertips in the palm's frame.
std::vector<Eigen::Vector3d> tips_at(const HandTree& hand, const std::vector<double>& q);

}  // namespace clench
