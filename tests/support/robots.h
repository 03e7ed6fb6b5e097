// Small robots described in code, for tests of model and motion.
#pragma once
#include <numbers>

#include "clench/model/world.h"
#include "support/chains.h"
#include "support/shapes.h"

namespace clench::test {

inline BodySpec body_spec(const std::string& name, Mesh mesh) {
  BodySpec spec;
  spec.name = name;
  spec.shape = Shape::make(std::move(mesh), name);
  return spec;
}

inline Mesh moved(Mesh mesh, const Eigen::Vector3d& by) {
  for (auto& v : mesh.vertices) v += by;
  return mesh;
}

/// A finger of two links, 50 mm each, along -x of their frames; it turns about z of its initial
/// frame, with one joint per link.
inline void add_finger(RobotSpec& robot, const Pose& X_BC, int dof, double ratio_of_second,
                       const std::string& prefix) {
  const double pi = std::numbers::pi;
  JointSpec joint;
  joint.X_PJ = X_BC;
  joint.dof = dof;
  joint.max = pi / 2;
  for (int l = 0; l < 2; ++l) {
    LinkSpec link{.body = body_spec(prefix + "_link" + std::to_string(l),
                                    moved(box(0.044, 0.01, 0.01), {-0.025, 0, 0}))};
    link.parent = l == 0 ? -1 : static_cast<int>(robot.links.size()) - 1;
    link.joints = {joint};
    link.X_JL = Pose::translation({0.05, 0, 0});
    robot.links.push_back(link);
    joint.X_PJ = {};
    joint.ratio = ratio_of_second;
    joint.max = pi / 2 * std::max(1.0, ratio_of_second);
  }
}

/// Two fingers along +y, 60 mm apart, that close towards each other; one DOF per finger.
inline RobotSpec two_finger(DofKind kind = DofKind::rigid, double ratio_of_second = 0.5) {
  const double pi = std::numbers::pi;
  RobotSpec robot;
  robot.name = "gripper";
  robot.base = body_spec("gripper_base", moved(box(0.08, 0.02, 0.02), {0, -0.016, 0}));
  DofSpec dof;
  dof.kind = kind;
  dof.default_velocity = 1;
  robot.dofs = {dof, dof};
  // the right finger turns counter-clockwise from +y; the left one is the same, rotated by half a
  // turn about y
  const Pose right{Eigen::Quaterniond(Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitZ())),
                   {0.03, 0, 0}};
  const Pose over = Pose::turn(pi, Eigen::Vector3d::UnitY());
  add_finger(robot, right, 0, ratio_of_second, "gripper_chain0");
  add_finger(robot, over * right, 1, ratio_of_second, "gripper_chain1");
  robot.X_BA = approach_frame({0, 0, 0}, {0, 1, 0});
  return robot;
}

}  // namespace clench::test
