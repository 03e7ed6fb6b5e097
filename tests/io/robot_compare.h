// Two robots compared by where their surfaces stand.
#pragma once
#include <doctest/doctest.h>

#include <map>

#include "base/random.h"
#include "spec/robot_spec.h"

namespace clench::test {

/// Poses of links in the base, by chain, by link: the formula of JointSpec, step by step.
inline std::vector<std::vector<Pose>> link_poses(const RobotSpec& robot,
                                                 const std::vector<double>& dofs) {
  std::vector<std::vector<Pose>> out;
  for (const ChainSpec& chain : robot.chains) {
    Pose X = chain.X_BC;
    if (chain.parent_chain >= 0) X = out[chain.parent_chain][chain.parent_link] * X;
    std::vector<Pose> frames = {X};
    for (const JointSpec& joint : chain.joints) {
      const double q = joint.ratio * dofs[joint.dof];
      const bool turns = joint.kind == JointKind::revolute;
      X = X * joint.X_before * Pose::turn(joint.theta + (turns ? q : 0), Eigen::Vector3d::UnitZ()) *
          Pose::translation({joint.a, 0, joint.d + (turns ? 0 : q)}) *
          Pose::turn(joint.alpha, Eigen::Vector3d::UnitX()) * joint.X_after;
      frames.push_back(X);
    }
    std::vector<Pose> links;
    for (const LinkSpec& link : chain.links)
      links.push_back(frames[link.last_joint + 1] * link.X_JL.value_or(Pose{}));
    out.push_back(links);
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

/// Points of every link's surface and its centre of mass, in the base, by the link's name.
inline std::map<std::string, std::vector<Eigen::Vector3d>> placed_points(
    const RobotSpec& robot, const std::vector<double>& dofs) {
  std::map<std::string, std::vector<Eigen::Vector3d>> out;
  const auto poses = link_poses(robot, dofs);
  const auto add = [&](const BodySpec& body, const Pose& X) {
    auto& points = out[bare_name(body, robot)];
    points.push_back(X * com_of(body));
    if (!body.shape) return;
    const auto& vertices = body.shape->mesh().vertices;
    for (size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / 20)
      points.push_back(X * vertices[i]);
  };
  add(robot.base, Pose{});
  for (size_t c = 0; c < poses.size(); ++c)
    for (size_t l = 0; l < poses[c].size(); ++l) add(robot.chains[c].links[l].body, poses[c][l]);
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
