// A robot of the world: its links, joints and DOFs.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clench/model/body.h"
#include "clench/spec/chains.h"
#include "clench/spec/dof_drive.h"
#include "clench/spec/world_spec.h"

namespace clench {

struct Joint : JointSpec {
  int link = 0;  ///< link that it moves, with all beyond
};

struct Link {
  Id<Body> body;
  int parent = -1;                     ///< an earlier link; -1: the base
  int first_joint = 0, end_joint = 0;  ///< its own, from the parent on: [first, end)
  Pose X_JL;                           ///< in the frame after the last joint, or the parent's
};

/// How another robot carries it.
struct Mounting {
  Id<Robot> parent;
  int link = 0;                   ///< of the parent
  Pose X_LB;                      ///< pose of our base in it
  std::optional<Id<Body>> piece;  ///< adapter, at the pose of our base
};

struct Robot {
  std::string name;
  std::string source;
  std::string file;  ///< the same, absolute
  std::string class_name;
  Id<Body> base;
  std::vector<DofSpec> dofs;
  /// one per DOF; for one that is not driven: the motor that a script may add
  std::vector<DofDrive> drives;
  std::vector<std::array<double, 2>> limits;  ///< one per DOF [rad or m]
  std::vector<bool> endless;                  ///< DOFs without stops at their limits
  std::vector<Link> links;
  std::vector<Joint> joints;              ///< link by link
  size_t first_dof = 0, first_joint = 0;  ///< index of its first one in the state's arrays
  std::vector<Chain> chains;              ///< the links as chains
  Pose X_BA;                              ///< approach frame: +z is the direction of approach
  std::optional<Mounting> mounting;
  /// null: none given, and each DOF has its own
  std::shared_ptr<const EigengraspSet> eigengrasps;
  /// null: none given; their links exist
  std::shared_ptr<const std::vector<VirtualContactSpec>> virtual_contacts;
  std::shared_ptr<const GloveCalibration> glove;
  RobotFiles files;  ///< origin of the three values above
  std::optional<TrackerSpec> tracker;
  std::shared_ptr<const PassiveParts> passive;  ///< null: none; stored for scripts
  std::vector<JointTendonSpec> joint_tendons;

  Id<Body> body_of(int link) const { return link < 0 ? base : links[link].body; }
};

/// Converts a spec. The robot has no bodies yet, and no entries in the state of a world.
Robot make_robot(const RobotSpec& spec);

/// Poses of joints and links, in the frame in which the base's pose is given.
struct RobotFrames {
  std::vector<Pose> joints;  ///< before its motion
  std::vector<Pose> links;

  Eigen::Vector3d axis(const Robot& robot, int joint) const {
    return joints[joint].rotation * robot.joints[joint].axis;
  }
  /// Velocity of a point carried by the joint, at unit speed of the joint [m per unit of the
  /// joint].
  Eigen::Vector3d velocity(const Robot& robot, int joint, const Eigen::Vector3d& p) const {
    const Eigen::Vector3d z = axis(robot, joint);
    if (robot.joints[joint].kind == JointKind::prismatic) return z;
    return z.cross(p - joints[joint].position);
  }
};
/// q  of the joints [rad or m]
void find_frames(const Robot& robot, const Pose& X_base, std::span<const double> q,
                 RobotFrames& out);

/// Indices of a chain's joints.
std::vector<int> joints_of(const Robot& robot, const Chain& chain);

/// Index of a joint in its chain, in the users' numbering.
int number_in_chain(const Robot& robot, int joint);

/// Does a joint move a link: is it between the base and the link?
/// link  -1: the base
bool joint_moves_link(const Robot& robot, int joint, int link);

}  // namespace clench
