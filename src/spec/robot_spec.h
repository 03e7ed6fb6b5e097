// A robot as a file describes it: a base, chains of joints after Denavit and Hartenberg, links, DOFs.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "math/pose.h"
#include "spec/body_spec.h"
#include "spec/eigengrasp_spec.h"
#include "spec/glove_spec.h"
#include "spec/tendon_spec.h"
#include "spec/virtual_contact_spec.h"

namespace clench {

enum class DofKind { rigid, breakaway, compliant };
enum class JointKind { revolute, prismatic };

/// One motor. Forces are torques [N m] when its joints are revolute, forces [N] when prismatic.
struct DofSpec {
  std::string name = {};  ///< as its file calls it; empty: it has none
  DofKind kind = DofKind::rigid;
  double default_velocity = 0;  ///< of closing [rad/s or m/s]; 0 does not move
  double max_effort = 0;        ///< [N m or N]
  double max_velocity = 0;      ///< [rad/s or m/s]; 0: not known
  double kp = 0, kd = 0;        ///< controller gains [N m/rad or N/m], [N m s/rad or N s/m]
  double breakaway_torque = 0;  ///< [N m]
  double dragger_scale = 0;     ///< size of its handle in a viewer [m]
  double default_value = 0;     ///< [rad or m]
};

/// q = ratio * dof; theta = theta + q (revolute) or d = d + q (prismatic).
/// frame after = frame before * X_before * Rz(theta) Tz(d) Tx(a) Rx(alpha) * X_after
/// (Denavit and Hartenberg 1955, distal; the two fixed poses are for files that place joints freely)
struct JointSpec {
  std::string name = {};  ///< as its file calls it; empty: it has none
  JointKind kind = JointKind::revolute;
  int dof = 0;
  double ratio = 1;
  double pull =
      0;  ///< of a compliant DOF: what the ratio was made of, see couple_by_springs; 0: not made
  double theta = 0, d = 0, a = 0, alpha = 0;  ///< constant parts [rad, m, m, rad]
  bool placed_freely = false;                 ///< has it fixed poses of its own?
  Pose X_before = {}, X_after = {};           ///< then; z after X_before is the axis
  double min = 0, max = 0;                    ///< of q [rad or m]
  double viscous = 0;                         ///< friction [N m s/rad or N s/m]
  double coulomb = 0;                         ///< friction [N m or N]
  double spring = 0;                          ///< stiffness [N m/rad or N/m]
  double rest = 0;                            ///< q at which the spring is slack [rad or m]
};

enum class LinkJoint { revolute, prismatic, universal, ball, fixed };

struct LinkSpec {
  BodySpec body;                          ///< frame: after its last joint, then X_JL
  LinkJoint joint = LinkJoint::revolute;  ///< how dynamics attaches it to the link before
  int last_joint = 0;             ///< index in the chain of the last joint that moves it; -1: none
  std::optional<Pose> X_JL = {};  ///< in the frame after that joint; absent: it is that frame
};

/// Joints in a row. A chain begins on the base, or on a link of a chain before it: a tree that branches
/// is a chain for each branch.
struct ChainSpec {
  int parent_chain = -1;  ///< -1: the base
  int parent_link = -1;   ///< index into the parent chain's links
  Pose X_BC;              ///< chain frame in the base, or in the parent link
  std::vector<JointSpec> joints;
  std::vector<LinkSpec> links;
};

/// Position sensor on the robot: number and mounting pose.
struct TrackerSpec {
  int number = 0;
  Pose X_BS;
};

/// What of a robot may never collide, beside its neighbours.
struct CollisionRules {
  std::vector<RobotPart> parts_off;                 ///< with nothing at all
  std::vector<std::array<RobotPart, 2>> pairs_off;  ///< with each other
  bool near_pairs_off = false;  ///< nor parts nearer than the contact threshold as it is loaded
};

/// Files that a robot's file names, resolved; empty: none.
struct RobotFiles {
  std::string eigengrasps, virtual_contacts, glove_calibration;
  /// what its reading was given to find them, absolute: a folder, and folders of URDF packages
  std::string folder = {};
  std::map<std::string, std::string> packages = {};
};

struct RobotSpec {
  std::string name;
  std::string source;         ///< file it was read from, as it was named
  std::string file;           ///< the same, absolute
  std::string class_name;     ///< first token of the file, e.g. "Barrett"
  std::string database_name;  ///< in a database of grasps; empty: none
  BodySpec base;
  std::vector<DofSpec> dofs;
  std::vector<ChainSpec> chains;
  bool chain_links_collide =
      false;  ///< may links of one chain meet that are no neighbours? the original's never do
  CollisionRules collision_rules;
  std::optional<Pose> X_BA;  ///< approach frame in the base: +z is the direction of approach
  std::optional<EigengraspSet> eigengrasps;
  std::optional<VirtualContactSet> virtual_contacts;
  std::optional<GloveCalibration> glove;
  RobotFiles files;  ///< where the three above come from
  std::optional<TrackerSpec> tracker;
  std::vector<TactileSpec> tactile;
  std::vector<TendonSpec> tendons;
  std::vector<TendonWrapper> wrappers;
};

/// Approach frame from a reference point and a direction, both in the base frame.
/// z along the direction, y = z x x0, with x0 = +x unless z lies within 26 degrees of it, then +y
Pose approach_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction);

/// Range of a DOF: intersection over its joints of [min, max] / ratio.   returns {low, high}
std::array<double, 2> dof_range(const RobotSpec& robot, int dof);
/// The end of a sentence about a range that is none.
std::string no_range(const std::array<double, 2>& range);

/// throws Error when it does not fit the robot's DOFs, chains and links
void check_fit(const RobotSpec& robot, const EigengraspSet& set);
void check_fit(const RobotSpec& robot, const VirtualContactSet& set);
void check_fit(const RobotSpec& robot, const GloveCalibration& glove);

/// throws Error with one sentence when a number is out of order: DOF indices, limits, last joints, DOFs
/// without a range; or when a rule of valid.h refuses a name, number or pose
void check_robot(const RobotSpec& robot);

}  // namespace clench
