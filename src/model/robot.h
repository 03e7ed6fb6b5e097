// A robot of the world: its chains, and the values of its DOFs.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/body.h"
#include "spec/world_spec.h"

namespace clench {

struct Chain {
  int parent_chain = -1;  ///< -1: it begins on the base
  int parent_link = -1;
  Pose X_BC;  ///< chain frame in the base, or in the parent link
  std::vector<JointSpec> joints;
  std::vector<Apart> apart;      ///< one per joint: its own q, where it does not follow its DOF
  std::vector<int> last_joints;  ///< one per link
  std::vector<std::optional<Pose>> X_JL;  ///< one per link: in the frame after its last joint
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
  std::string file;  ///< the same, absolute
  std::string class_name;
  Id<Body> base;
  std::vector<DofSpec> dofs;
  std::vector<std::array<double, 2>> limits;  ///< one per DOF [rad or m]
  Eigen::VectorXd q;                          ///< one per DOF [rad or m]
  std::vector<Chain> chains;
  Pose X_BA;  ///< approach frame: +z is the direction of approach
  std::optional<Mounting> mounting;
  /// null: none given, and each DOF is its own
  std::shared_ptr<const EigengraspSet> eigengrasps;
  /// null: none given; their chains and links exist
  std::shared_ptr<const std::vector<VirtualContactSpec>> virtual_contacts;
  std::shared_ptr<const GloveCalibration> glove;
  RobotFiles files;  ///< where the three above came from
  std::optional<TrackerSpec> tracker;
  std::shared_ptr<const PassiveParts> passive;  ///< null: none; nothing acts on them yet
};

/// q of a joint: ratio * dof, or its own.
double joint_value(const Robot& robot, int chain, int joint);

/// Frame of a joint after it has turned or slid by q, in the frame before.
Pose joint_pose(const JointSpec& joint, double q);

/// Where a chain's joints stand, in the base frame.
struct ChainFrames {
  Pose start;               ///< the chain frame
  std::vector<Pose> axes;   ///< one per joint: its axis is z
  std::vector<Pose> after;  ///< one per joint: after its motion
  std::vector<Pose> links;  ///< one per link
};

/// One a chain.
std::vector<ChainFrames> chain_frames(const Robot& robot);

/// Does a joint move a link: is it on the way from the base to the link?
bool joint_moves_link(const Robot& robot, int joint_chain, int joint, int chain, int link);

}  // namespace clench
