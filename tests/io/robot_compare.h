// Compares two robots by the positions of their surfaces.
#pragma once
#include <doctest/doctest.h>

#include <map>

#include "clench/base/random.h"
#include "clench/spec/robot_spec.h"
#include "support/chains.h"

namespace clench::test {

/// Poses of links in the base: the formula of LinkSpec, step by step, as matrices.
inline std::vector<Eigen::Isometry3d> slow_link_poses(const RobotSpec& robot,
                                                      const std::vector<double>& dofs) {
  const auto matrix = [](const Pose& X) { return Eigen::Translation3d(X.position) * X.rotation; };
  std::vector<Eigen::Isometry3d> out;
  for (const LinkSpec& link : robot.links) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    if (link.parent >= 0) X = out[link.parent];
    for (const JointSpec& joint : link.joints) {
      const double q = joint.ratio * dofs[joint.dof];
      X = X * matrix(joint.X_PJ);
      if (joint.kind == JointKind::revolute)
        X = X * Eigen::AngleAxisd(q, joint.axis);
      else
        X = X * Eigen::Translation3d(q * joint.axis);
    }
    out.push_back(X * matrix(link.X_JL));
  }
  return out;
}

inline std::vector<double> any_dofs(const RobotSpec& robot, Random& random) {
  std::vector<double> out;
  for (size_t d = 0; d < robot.dofs.size(); ++d) {
    const auto [low, high] = dof_range(robot, static_cast<int>(d));
    out.push_back(random.uniform(low, high));
  }
  return out;
}

/// The name of a link without that of its robot.
inline std::string bare_name(const BodySpec& body, const RobotSpec& robot) {
  return body.name.starts_with(robot.name + "_") ? body.name.substr(robot.name.size() + 1)
                                                 : body.name;
}

/// Points of every link's surface and its center of mass, in the base, by the link's name.
inline std::map<std::string, std::vector<Eigen::Vector3d>> placed_points(
    const RobotSpec& robot, const std::vector<double>& dofs) {
  std::map<std::string, std::vector<Eigen::Vector3d>> out;
  const auto poses = slow_link_poses(robot, dofs);
  const auto add = [&](const BodySpec& body, const Eigen::Isometry3d& X) {
    auto& points = out[bare_name(body, robot)];
    points.push_back(X * com_of(body));
    if (!body.shape) return;
    const auto& vertices = body.shape->mesh().vertices;
    for (size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / 20)
      points.push_back(X * vertices[i]);
  };
  add(robot.base, Eigen::Isometry3d::Identity());
  for (size_t l = 0; l < poses.size(); ++l) add(robot.links[l].body, poses[l]);
  return out;
}

/// The largest distance between points of the same links, over some values of the DOFs.
inline double largest_gap(const RobotSpec& a, const RobotSpec& b, int postures = 10) {
  Random random(7, 0);
  double out = 0;
  for (int k = 0; k < postures; ++k) {
    const auto dofs = any_dofs(a, random);
    const auto at = placed_points(a, dofs);
    auto bt = placed_points(b, dofs);
    for (const auto& [name, points] : at) {
      INFO(name);
      REQUIRE(bt.contains(name));
      REQUIRE(bt[name].size() == points.size());
      for (size_t i = 0; i < points.size(); ++i)
        out = std::max(out, (points[i] - bt[name][i]).norm());
    }
  }
  return out;
}

}  // namespace clench::test
