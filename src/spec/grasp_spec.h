// A grasp as a value, independent of a world: results of planners, entries of files and lists.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clench/math/pose.h"
#include "clench/spec/point_contact.h"

namespace clench {

/// Reference lengths of an object by which torques may be divided.
enum class TorqueLength {
  largest_radius,   ///< largest distance of its surface from its center of mass
  gyration_radius,  ///< root mean square distance of its mass from its center of mass
};

/// A number per contact: none, one for all contacts, or one for each.
struct PerContact {
  std::vector<double> values = {};

  PerContact() = default;
  PerContact(double all) : values{all} {}
  PerContact(std::vector<double> each) : values(std::move(each)) {}
  explicit operator bool() const { return !values.empty(); }
  double of(int contact) const { return values.size() == 1 ? values[0] : values[contact]; }
  bool fits(size_t contacts) const { return values.size() <= 1 || values.size() == contacts; }
};

/// How the compliances of two elastic bodies are combined.
enum class ModulusRule {
  series,  ///< both are compliant: sums of layer (1 - poisson^2) / modulus
  larger   ///< as GraspIt!: only the layer of the stiffer elastic body, Poisson's ratio unused
};

struct GraspOptions {
  int edges = 8;                   ///< of the friction pyramids; round_edges: round cones
  std::optional<double> rho = {};  ///< torque length [m]; default: that of the object
  TorqueLength length = TorqueLength::largest_radius;
  /// soft contacts transmit torsional friction; otherwise all are point contacts
  bool soft = true;
  PerContact normal_force = 5;  ///< for which contacts are evaluated, > 0, one per contact >= 0 [N]
  ModulusRule modulus = ModulusRule::series;
};

/// State of a hand before it approaches the object and closes.
struct PregraspState {
  Pose X_OH;                 ///< its base in the object
  std::vector<double> dofs;  ///< values of all [rad or m]
};

struct GraspSpec {
  std::string hand_name = {}, object_name = {};
  std::string hand_file = {}, object_file = {};  ///< files of hand and object; empty: unknown
  /// shapes, links and joints of the hand, and surface of the object; empty: unknown
  std::string hand_fingerprint = {}, object_fingerprint = {};
  std::string settings_fingerprint = {};    ///< of edges, rho and the other options of its measures
  std::string engine_version = {};          ///< of the program that measured it
  std::optional<Pose> X_OH = {};            ///< the hand's base in the object; empty: unknown
  std::vector<double> dofs = {};            ///< values of all, or of the named ones [rad or m]
  std::vector<std::string> dof_names = {};  ///< empty: unknown, and `dofs` has all DOFs in order
  std::vector<std::string> dof_units = {};  ///< "rad" or "m", as many as names
  std::vector<double> joints = {};          ///< positions of all [rad or m]
  std::vector<std::string> joint_names = {};  ///< one name per joint, or empty: unknown
  std::vector<std::string> joint_units = {};  ///< "rad" or "m", as many as names
  /// position + offset is the value of a joint in the hand's own file; empty: all are 0
  std::vector<double> joint_offsets = {};
  std::vector<PointContact> points = {};
  std::vector<std::string> links = {};             ///< one per contact: the body in contact
  Eigen::Vector3d com = Eigen::Vector3d::Zero();   ///< of the object, object frame [m]
  double rho = 1;                                  ///< by which torques are divided [m]
  double largest_radius = 1, gyration_radius = 1;  ///< of the object; 1 if it has no extent [m]
  GraspOptions options = {};                       ///< that it was measured with
  /// of the grasp, by name, as far as requested
  std::map<std::string, double> measures = {};
  /// numbers recorded by its planner: energy, seed, run, spread [rad]
  std::map<std::string, double> info = {};
  std::map<std::string, std::string> labels = {};  ///< texts recorded likewise: planner, script
  std::optional<PregraspState> pregrasp = {};
  /// targets of the motors that press on the object, one per DOF [rad or m]; empty: unknown
  std::vector<double> squeeze = {};
  /// was the hand in collision in the grasp? empty: not checked
  std::optional<bool> collision_free = {};

  /// Value of a joint in the hand's own file, as other programs use it [rad or m].
  double joint_value(size_t joint) const {
    return joint < joint_offsets.size() ? joints[joint] + joint_offsets[joint] : joints[joint];
  }
  double length(TorqueLength which) const {
    return which == TorqueLength::largest_radius ? largest_radius : gyration_radius;
  }
};

}  // namespace clench
