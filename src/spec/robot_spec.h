// A robot as a file describes it: a base, chains of joints after Denavit and Hartenberg, links, DOFs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "math/pose.h"
#include "spec/body_spec.h"

namespace clench {

enum class DofKind { rigid, breakaway, compliant };
enum class JointKind { revolute, prismatic };

/// One motor. Forces are torques [N m] when its joints are revolute, forces [N] when prismatic.
struct DofSpec {
  DofKind kind = DofKind::rigid;
  double default_velocity = 0;  ///< of closing [rad/s or m/s]; 0 does not move
  double max_effort = 0;        ///< [N m or N]
  double kp = 0, kd = 0;        ///< controller gains [N m/rad or N/m], [N m s/rad or N s/m]
  double breakaway_torque = 0;  ///< [N m]
  double dragger_scale = 0;     ///< size of its handle in a viewer [m]
  double default_value = 0;     ///< [rad or m]
};

/// q = ratio * dof; theta = theta + q (revolute) or d = d + q (prismatic).
/// frame after = frame before * Rz(theta) Tz(d) Tx(a) Rx(alpha)   (Denavit and Hartenberg 1955, distal)
struct JointSpec {
  JointKind kind = JointKind::revolute;
  int dof = 0;
  double ratio = 1;
  double theta = 0, d = 0, a = 0, alpha = 0;  ///< constant parts [rad, m, m, rad]
  double min = 0, max = 0;                    ///< of q [rad or m]
  double viscous = 0;                         ///< friction [N m s/rad or N s/m]
  double coulomb = 0;                         ///< friction [N m or N]
  double spring = 0;                          ///< stiffness [N m/rad or N/m]
  double rest = 0;                            ///< q at which the spring is slack [rad or m]
};

enum class LinkJoint { revolute, prismatic, universal, ball, fixed };

struct LinkSpec {
  BodySpec body;                          ///< frame: after its last joint
  LinkJoint joint = LinkJoint::revolute;  ///< how dynamics attaches it to the link before
  int last_joint = 0;  ///< index in the chain of the last joint that moves it; -1: none
};

struct ChainSpec {
  Pose X_BC;  ///< chain frame in the base
  std::vector<JointSpec> joints;
  std::vector<LinkSpec> links;
};

/// Position sensor on the robot: number and mounting pose.
struct TrackerSpec {
  int number = 0;
  Pose X_BS;
};

struct RobotSpec {
  std::string name;
  std::string source;      ///< file it was read from, as it was named
  std::string class_name;  ///< first token of the file, e.g. "Barrett"
  BodySpec base;
  std::vector<DofSpec> dofs;
  std::vector<ChainSpec> chains;
  std::optional<Pose> X_BA;  ///< approach frame in the base: +z is the direction of approach
  std::string eigengrasps;   ///< files it names, resolved; empty: none
  std::string virtual_contacts;
  std::string glove_calibration;
  std::optional<TrackerSpec> tracker;
};

/// Approach frame from a reference point and a direction, both in the base frame.
/// z along the direction, y = z x x0, with x0 = +x unless z lies within 26 degrees of it, then +y
Pose approach_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction);

/// Range of a DOF: intersection over its joints of [min, max] / ratio.   returns {low, high}
std::array<double, 2> dof_range(const RobotSpec& robot, int dof);

/// throws Error with one sentence when a number is out of order: DOF indices, ratios, limits, last
/// joints, lengths and angles that are not finite or beyond 1e30, DOFs without a finite range
void check_robot(const RobotSpec& robot);

}  // namespace clench
