// Our tree as that of a URDF: links whose frames stand on the axes, one joint between two.
#pragma once
#include <optional>

#include "clench/spec/chains.h"

namespace clench {

struct UrdfLink {
  std::string name;
  const BodySpec* body = nullptr;  ///< null: a frame between two joints of one link
  Pose X_UB;                       ///< the body's frame in the link's
};

/// Fixed when it has no spec. v = factor * DOF, where v is its value in the file.
struct UrdfJoint {
  std::string name;
  int parent = 0, child = 0;                        ///< indices of links
  Pose X_PC;                                        ///< child in the parent at v = 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< in the child
  const JointSpec* spec = nullptr;
  bool leads = false;  ///< does its value stand for the DOF?
  double factor = 1;
  double min = 0, max = 0;  ///< of v [rad or m]
  bool endless = false;     ///< as JointSpec
};

struct UrdfPlan {
  std::string name;
  std::vector<UrdfLink> links;       ///< [0] is the base
  std::vector<UrdfJoint> joints;     ///< in an order in which leaders come as their DOFs do
  std::vector<int> link_of;          ///< by our link
  std::vector<int> leader_of;        ///< by DOF: index of a joint; -1: it moves none
  std::vector<std::string> renamed;  ///< sentences: what could not keep its name

  int link(int ours) const { return ours < 0 ? 0 : link_of[ours]; }
};

/// `robot` has to outlive the plan.
UrdfPlan plan_urdf(const RobotSpec& robot);

/// Links and joints as a reader of the file numbers them, and the chains that they form. Links have
/// names, parents and joints, joints their kinds; nothing else is set.
RobotSpec outline_of(const UrdfPlan& plan);

}  // namespace clench
