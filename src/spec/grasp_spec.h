// A grasp as a value: what a planner yields, a file keeps and a list shows. It needs no world.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clench/math/pose.h"
#include "clench/spec/point_contact.h"

namespace clench {

/// Lengths of an object that torques may be divided by.
enum class TorqueLength {
  largest_radius,   ///< of its surface, from its centre of mass
  gyration_radius,  ///< root mean square of its mass, from its centre of mass
};

/// A number that is asked of each contact: none, one for all contacts, or one per contact.
struct PerContact {
  std::vector<double> values = {};

  PerContact() = default;
  PerContact(double all) : values{all} {}
  PerContact(std::vector<double> each) : values(std::move(each)) {}
  explicit operator bool() const { return !values.empty(); }
  double of(int contact) const { return values.size() == 1 ? values[0] : values[contact]; }
  bool fits(size_t contacts) const { return values.size() <= 1 || values.size() == contacts; }
};

/// How two elastic bodies act together.
enum class ModulusRule {
  series,  ///< each gives way: sums of layer (1 - poisson^2) / modulus
  larger   ///< as the original: the layer of the stiffer elastic body alone, poisson's ratio unused
};

struct GraspOptions {
  int edges = 8;                   ///< of the friction pyramids; round_edges: round cones
  std::optional<double> rho = {};  ///< torque length [m]; default: that of the object
  TorqueLength length = TorqueLength::largest_radius;
  bool soft = true;             ///< soft contacts transmit torsional friction; else all are points
  PerContact normal_force = 5;  ///< at which they are judged, > 0, one per contact >= 0 [N]
  ModulusRule modulus = ModulusRule::series;
};

/// How a hand stands before it comes to the object and closes.
struct PregraspState {
  Pose X_OH;                 ///< its base in the object
  std::vector<double> dofs;  ///< values of all [rad or m]
};

struct GraspSpec {
  std::string hand_name = {}, object_name = {};
  std::string hand_file = {}, object_file = {};  ///< where they come from; empty: not known
  /// shapes, links and joints of the hand, and surface of the object; empty: not known
  std::string hand_fingerprint = {}, object_fingerprint = {};
  std::string settings_fingerprint = {};  ///< of edges, rho and the other options of its measures
  std::string engine_version = {};        ///< of the program that measured it
  std::optional<Pose> X_OH = {};  ///< the hand's base in the object; empty: put together by hand
  std::vector<double> dofs = {};  ///< values of all [rad or m]; of those that are named, else
  std::vector<std::string> dof_names = {};    ///< empty: not known, and the DOFs are all in order
  std::vector<std::string> dof_units = {};    ///< "rad" or "m", as many as names
  std::vector<double> joints = {};            ///< positions of all [rad or m]
  std::vector<std::string> joint_names = {};  ///< as many as joints, else empty: not known
  std::vector<std::string> joint_units = {};  ///< "rad" or "m", as many as names
  /// position + offset is the value of a joint in the hand's own file; empty: all are 0
  std::vector<double> joint_offsets = {};
  std::vector<PointContact> points = {};
  std::vector<std::string> links = {};             ///< one per contact: what touches there
  Eigen::Vector3d com = Eigen::Vector3d::Zero();   ///< of the object, object frame [m]
  double rho = 1;                                  ///< that torques are divided by [m]
  double largest_radius = 1, gyration_radius = 1;  ///< of the object; 1 when it has no extent [m]
  GraspOptions options = {};                       ///< that it was measured with
  /// of the grasp, by name, as far as they were asked for
  std::map<std::string, double> measures = {};
  /// what its maker notes: energy, seed, run, spread [rad]
  std::map<std::string, double> info = {};
  std::map<std::string, std::string> labels = {};  ///< the same in words: planner, script
  std::optional<PregraspState> pregrasp = {};
  /// targets of the motors that press on the object, one per DOF [rad or m]; empty: not known
  std::vector<double> squeeze = {};
  std::optional<bool> collision_free = {};  ///< was the hand, as it grasped? empty: nobody looked

  /// Value of a joint in the hand's own file, as other programs count it [rad or m].
  double joint_value(size_t joint) const {
    return joint < joint_offsets.size() ? joints[joint] + joint_offsets[joint] : joints[joint];
  }
  double length(TorqueLength which) const {
    return which == TorqueLength::largest_radius ? largest_radius : gyration_radius;
  }
};

}  // namespace clench
