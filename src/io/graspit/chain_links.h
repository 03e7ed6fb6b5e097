// Chains of files of the original, joints after Denavit and Hartenberg, become links of a tree.
#pragma once
#include "clench/spec/chains.h"

namespace clench {

/// Constant parts of the four numbers of a joint. Frame after it = frame before * Rz(theta) Tz(d)
/// Tx(a) Rx(alpha), with q added to theta (revolute) or d (prismatic).
/// source  Denavit & Hartenberg (1955), distal
struct DenavitHartenberg {
  double theta = 0, d = 0, a = 0, alpha = 0;  ///< [rad, m, m, rad]
};

/// Number of joints that the dynamics of the original give a link of a kind: Revolute, Prismatic,
/// Universal, Ball, Fixed.
/// throws Error "expected Revolute, Prismatic, Universal, Ball or Fixed, got 'Revolut'; did you
/// mean 'Revolute'?"
int joints_of_kind(std::string_view word);

/// Joints and links of one chain, as they come.
class ChainLinks {
 public:
  explicit ChainLinks(const Pose& X_BC) : at_(X_BC) {}
  /// throws Error "joint 2: theta: expected a number from -1e+09 to 1e+09 [rad], got 1e+20"
  void add_joint(const JointSpec& joint, const DenavitHartenberg& numbers);
  int joints() const { return static_cast<int>(joints_.size()); }
  int last_joint() const { return used_ - 1; }  ///< that moves the last link; -1: none
  /// The next link: all joints up to `last_joint` move it, which is not before those of the link
  /// before.
  void add_link(const BodySpec& body, int last_joint, RobotSpec& robot);

 private:
  std::vector<JointSpec> joints_;
  std::vector<Pose> after_;  // of each joint, at q = 0, in its own frame
  Pose at_;                  // from the last link, or the base, to the next joint
  int used_ = 0;             // joints that have their link
  int parent_ = -1;
};

}  // namespace clench
