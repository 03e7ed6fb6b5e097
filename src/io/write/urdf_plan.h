// A robot's tree as a URDF tree: the frame of a link is on the axis of its joint, and exactly one
// joint connects two links.
#pragma once
#include <optional>

#include "clench/spec/chains.h"

namespace clench {

struct UrdfLink {
  std::string name;
  const BodySpec* body = nullptr;  ///< null: a frame between two joints of one link
  Pose X_UB;                       ///< pose of the body's frame in the link's frame
};

/// Fixed if it has no spec. v = factor * DOF, v: the joint's value in the file.
struct UrdfJoint {
  std::string name;
  int parent = 0, child = 0;                        ///< indices of links
  Pose X_PC;                                        ///< child in the parent at v = 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< in the child
  const JointSpec* spec = nullptr;
  bool leads = false;  ///< true if its value represents the DOF
  double factor = 1;
  double min = 0, max = 0;  ///< of v [rad or m]
  bool endless = false;     ///< as JointSpec
};

struct UrdfPlan {
  std::string name;
  std::vector<UrdfLink> links;       ///< [0] is the base
  std::vector<UrdfJoint> joints;     ///< sorted so that leaders have the order of their DOFs
  std::vector<int> link_of;          ///< index in `links` per link of the robot
  std::vector<int> leader_of;        ///< by DOF: index of a joint; -1: it moves no joint
  std::vector<std::string> renamed;  ///< messages about names that had to change

  int link(int ours) const { return ours < 0 ? 0 : link_of[ours]; }
};

/// `robot` must outlive the plan.
UrdfPlan plan_urdf(const RobotSpec& robot);

/// Links and joints as a reader of the file numbers them, and the chains that they form. Only
/// names, parents and joints of links and the kinds of joints are set.
RobotSpec outline_of(const UrdfPlan& plan);

}  // namespace clench
