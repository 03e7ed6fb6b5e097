// A robot as described by a file: a base, a tree of links that joints move, and the DOFs that move
// the joints.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clench/math/pose.h"
#include "clench/spec/body_spec.h"
#include "clench/spec/eigengrasp_spec.h"
#include "clench/spec/glove_spec.h"
#include "clench/spec/joint_tendon.h"
#include "clench/spec/own_friction.h"
#include "clench/spec/passive_parts.h"
#include "clench/spec/virtual_contact_spec.h"

namespace clench {

enum class DofKind { rigid, breakaway, compliant };
enum class JointKind { revolute, prismatic };

/// One motor. Forces are torques [N m] when its joints are revolute, forces [N] when prismatic.
struct DofSpec {
  std::string name = {};  ///< name in its file; empty: none
  DofKind kind = DofKind::rigid;
  bool driven = true;           ///< false: no motor holds it in simulations, unless requested
  double default_velocity = 0;  ///< of closing [rad/s or m/s]; 0: does not close
  double max_effort = 0;        ///< [N m or N]
  double max_velocity = 0;      ///< [rad/s or m/s]; 0: unknown
  double kp = 0, kd = 0;        ///< controller gains [N m/rad or N/m], [N m s/rad or N s/m]
  double damping_ratio = 0;  ///< adds 2 damping_ratio sqrt(kp inertia) to kd; 1: critical damping
  double breakaway_torque = 0;  ///< [N m]
  double dragger_scale = 0;     ///< size of its handle in a viewer [m]
  double default_value = 0;     ///< [rad or m]
};

/// Rotates about, or slides along, an axis through the origin of the joint's frame: q = ratio *
/// dof.
struct JointSpec {
  std::string name = {};  ///< name in its file; empty: none
  JointKind kind = JointKind::revolute;
  /// at q = 0, in the frame of the link's parent, or in that after the link's previous joint
  Pose X_PJ = {};
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit, in the joint's frame
  int dof = 0;
  double ratio = 1;
  double min = 0, max = 0;  ///< of q [rad or m]
  bool endless = false;     ///< without stops: min and max are the range for closing and searches
  double viscous = 0;       ///< friction [N m s/rad or N s/m]
  double coulomb = 0;       ///< friction [N m or N]
  double armature = 0;      ///< inertia of its motor's rotor, reflected at the joint [kg m^2 or kg]
  double spring = 0;        ///< stiffness [N m/rad or N/m]
  double rest = 0;          ///< q at which the spring is slack [rad or m]
  /// bound on the sum of the efforts of all actuators on the joint; absent: unbounded [N m or N]
  std::optional<std::array<double, 2>> effort_range = {};
  double offset = 0;  ///< the joint's value in its file is q + offset [rad or m]
};

/// Transform of the joint at q, in its frame.
Pose joint_motion(const JointSpec& joint, double q);

/// A rigid part, and the joints between it and its parent.
/// its frame = parent's frame * (X_PJ * motion) of each joint * X_JL
struct LinkSpec {
  BodySpec body = {};
  int parent = -1;                     ///< an earlier link; -1: the base
  std::vector<JointSpec> joints = {};  ///< the parent's side first; empty: it is fixed
  Pose X_JL = {};                      ///< in the frame after the last joint
};

/// Position sensor on the robot: number and mounting pose.
struct TrackerSpec {
  int number = 0;
  Pose X_BS;
};

/// Pairs of parts of a robot that cannot collide, in addition to neighbors: a link and its carrier.
struct CollisionRules {
  std::vector<int> parts_off;                 ///< links that collide with nothing; -1: the base
  std::vector<std::array<int, 2>> pairs_off;  ///< with each other
  /// nor with parts that are nearer than the contact threshold when the robot is loaded
  bool near_pairs_off = false;
  std::vector<std::array<int, 2>> pairs_on;  ///< neighbors that can collide nevertheless
};

/// Resolved files that a robot's file refers to; empty: none.
struct RobotFiles {
  std::string eigengrasps, virtual_contacts, glove_calibration;
  /// search paths used when it was read, absolute: a folder, and folders of URDF packages
  std::string folder = {};
  std::map<std::string, std::string> packages = {};
  std::string body = {};  ///< in a scene: the body at the root of its tree of joints
};

struct RobotSpec {
  std::string name;
  std::string source;         ///< file it was read from, as it was named
  std::string file;           ///< the same, absolute
  std::string class_name;     ///< first token of the file, e.g. "Barrett"
  std::string database_name;  ///< in a grasp database; empty: none
  BodySpec base;
  std::vector<DofSpec> dofs;
  std::vector<LinkSpec> links;
  /// may links of one chain collide that are not neighbors? in GraspIt! they never do
  bool chain_links_collide = false;
  CollisionRules collision_rules;
  std::optional<Pose> X_BA;  ///< approach frame in the base: +z is the direction of approach
  std::optional<EigengraspSet> eigengrasps;
  std::optional<std::vector<VirtualContactSpec>> virtual_contacts;
  std::optional<GloveCalibration> glove;
  RobotFiles files;  ///< origins of the three values above
  /// frictions assigned by its file to its parts; their materials have the names of material_name()
  std::vector<OwnFriction> frictions;
  std::optional<TrackerSpec> tracker;
  std::vector<TactileSpec> tactile;
  std::vector<TendonSpec> tendons;
  std::vector<TendonWrapper> wrappers;
  std::vector<JointTendonSpec> joint_tendons;
  /// in the file's order; the properties that motors use are in dofs
  std::vector<ActuatorSpec> actuators;
};

/// Approach frame from a reference point and a direction, both in the base frame.
/// z along the direction, y = z x x0, with x0 = +x unless z lies within 26 degrees of it, otherwise
/// +y
Pose approach_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction);

/// Range of a DOF: intersection over its joints of [min, max] / ratio.   returns {low, high}
std::array<double, 2> dof_range(const RobotSpec& robot, int dof);
/// Do all of its joints lack stops?
bool dof_is_endless(const RobotSpec& robot, int dof);
/// End of a message about an empty range.
std::string no_range(const std::array<double, 2>& range);

/// Visits all joints, link by link.
template <class Visit>
void each_joint(const RobotSpec& robot, Visit visit) {
  for (const LinkSpec& link : robot.links)
    for (const JointSpec& joint : link.joints) visit(joint);
}

/// Pose of a link in its parent's frame.
/// q  one per DOF [rad or m]
Pose link_in_parent(const LinkSpec& link, const std::vector<double>& q);
/// Poses of the links in the base's frame.
std::vector<Pose> link_poses(const RobotSpec& robot, const std::vector<double>& q);

/// Does the DOF's first joint slide? Then the DOF's unit is the meter, otherwise the radian.
bool dof_slides(const RobotSpec& robot, int dof);

}  // namespace clench
