// A robot as a hand: its palm, and the fingers that hang on it.
//
// Fingers are the links that end the tree, as far as joints lie between them and the palm; the palm
// is the last link that all of them hang on. A single finger of one or two joints closes against
// what carries it; a longer one is an arm, and has no fingers.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

struct Finger {
  int tip = 0;             ///< link
  std::vector<int> links;  ///< between palm and tip, from the palm on, and the tip
  Eigen::Vector3d p_tip;   ///< in the tip's frame
};

/// Values of all DOFs, and where they put the links in the base's frame.
struct Posture {
  std::vector<double> q;
  std::vector<Pose> poses;

  Pose at(int link) const { return link < 0 ? Pose{} : poses[link]; }
};

struct HandTree {
  const RobotSpec& robot;
  int palm = -1;
  std::vector<Finger> fingers;
  std::vector<int> dofs;                      ///< that can move
  Posture rest;                               ///< at first
  std::vector<std::array<double, 2>> ranges;  ///< one per DOF

  /// Does the DOF go round and round?
  bool turns_without_end(int dof) const;
};

HandTree hand_tree(const RobotSpec& robot);

const BodySpec& body_of(const RobotSpec& robot, int link);
/// What it looks like: its geometry, or without any what is drawn of it; may be null.
const ShapePtr& drawn(const BodySpec& body);
/// Joints of the links between an ancestor, which is not among them, and a link, which is.
std::vector<const JointSpec*> joints_below(const RobotSpec& robot, int ancestor, int link);
/// Fingertips in the palm's frame.
std::vector<Eigen::Vector3d> tips_at(const HandTree& hand, const std::vector<double>& q);

}  // namespace clench
