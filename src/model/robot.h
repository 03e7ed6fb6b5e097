// A robot of the world: its chains, and the values of its DOFs.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/body.h"
#include "spec/world_spec.h"

namespace clench {

struct Chain {
  Pose X_BC;  ///< chain frame in the base
  std::vector<JointSpec> joints;
  std::vector<Breakaway> breakaway;  ///< one a joint: q where it broke away, else empty
  std::vector<int> last_joints;      ///< one a link
  std::vector<LinkJoint> link_joints;
  std::vector<Id<Body>> links;
};

/// How a robot is carried by another one.
struct Mounting {
  Id<Robot> parent;
  int chain = 0;
  Pose X_LB;                      ///< our base in the parent's last link
  std::optional<Id<Body>> piece;  ///< adapter, stands where our base stands
};

struct Robot {
  std::string name;
  std::string source;
  std::string class_name;
  Id<Body> base;
  std::vector<DofSpec> dofs;
  std::vector<std::array<double, 2>> limits;  ///< one a DOF [rad or m]
  Eigen::VectorXd q;                          ///< one a DOF [rad or m]
  std::vector<Chain> chains;
  Pose X_BA;  ///< approach frame: +z is the direction of approach
  std::optional<Mounting> mounting;
  std::string eigengrasps, virtual_contacts, glove_calibration;  ///< files that its file names
  std::optional<TrackerSpec> tracker;
};

/// q of a joint: ratio * dof, or where it broke away.
double joint_value(const Robot& robot, int chain, int joint);

/// Frame of a joint after it has turned or slid by q, in the frame before.
Pose joint_pose(const JointSpec& joint, double q);

/// Frames of a chain in the base frame: [0] the chain frame, [j + 1] after joint j.
std::vector<Pose> chain_frames(const Robot& robot, int chain);

}  // namespace clench
