// A hand, an object and grasps as written by tests/bench/verdicts.lua: plain numbers, without
// Clench's types.
#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "bench/verdicts/convex_pieces.h"

namespace clench::bench {

struct GripBody {
  std::string name;
  double mass = 0;                                    // [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      // in the body's frame [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about com [kg m^2]
  std::vector<Points> pieces;                         // convex, in the body's frame [m]
};

struct GripLink {
  GripBody body;
  int parent = -1;  // links[0] is the base
  Eigen::Isometry3d pose =
      Eigen::Isometry3d::Identity();  // in the base frame, with all DOFs at their `value`
  bool has_joint = false, turns = true;
  int dof = 0;
  double ratio = 1;  // motion of the joint per motion of its DOF
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX(),
                  point = Eigen::Vector3d::Zero();  // of the joint, in the base frame
};

struct GripDof {
  double value = 0, min = 0, max = 0;  // [rad or m]
  double damping = 0, friction = 0, armature = 0;
};

struct StoredGrasp {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // of the hand in the object's frame
  std::vector<double> dofs,
      // torques: of the motors, in addition to those that hold the posture; empty: none found
      torques;
  double epsilon = 0, load = 0;
  // mean torsion radius of each link's contacts: friction resists torques about the normal up to mu
  // times the force times this radius; 0 for hard links, empty if all are hard [m]
  std::vector<double> torsion_radii;
  bool verified = false;  // by `clench plan --verify`
  int held = 0;           // number of the six directions in which study.shake held it
  bool survived = false;
};

struct GripTable {
  Eigen::Vector3d point, up;  // of the table's top, in the object's frame [m]; up: unit
};

struct GripScene {
  std::string hand_name, object_name;
  std::optional<GripTable> table;  // supports the object
  std::vector<GripLink> links;
  std::vector<GripDof> dofs;
  GripBody object;
  double mu = 0, force = 0;  // of the shake [N]
  std::vector<StoredGrasp> grasps;
};

/// throws  std::exception if the file does not have the format of verdicts.lua
GripScene read_grip_scene(const std::string& path);

}  // namespace clench::bench
