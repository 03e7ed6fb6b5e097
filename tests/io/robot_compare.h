// Two robots compared: field by field, and by where their surfaces stand.
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

enum class By { name, number };

/// Points of every link's surface and its centre of mass, in the base, by the link's name or
/// number.
inline std::map<std::string, std::vector<Eigen::Vector3d>> placed_points(
    const RobotSpec& robot, const std::vector<double>& dofs, By by) {
  std::map<std::string, std::vector<Eigen::Vector3d>> out;
  const auto poses = link_poses(robot, dofs);
  const auto add = [&](const BodySpec& body, const Pose& X, size_t c, size_t l) {
    auto& points =
        out[by == By::name ? bare_name(body, robot) : std::to_string(c) + " " + std::to_string(l)];
    points.push_back(X * com_of(body));
    if (!body.shape) return;
    const auto& vertices = body.shape->mesh().vertices;
    for (size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / 20)
      points.push_back(X * vertices[i]);
  };
  add(robot.base, Pose{}, 99, 99);
  for (size_t c = 0; c < poses.size(); ++c)
    for (size_t l = 0; l < poses[c].size(); ++l)
      add(robot.chains[c].links[l].body, poses[c][l], c, l);
  return out;
}

/// The largest distance between points of the same links, over some values of the DOFs.
inline double largest_gap(const RobotSpec& a, const RobotSpec& b, By by, int postures = 10) {
  Random random(7, 0);
  double out = 0;
  for (int k = 0; k < postures; ++k) {
    const auto dofs = any_dofs(a, random);
    const auto at = placed_points(a, dofs, by);
    auto bt = placed_points(b, dofs, by);
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

// numbers that went through a product, and all that comes of a direction made unit again
inline constexpr double rounding = 1e-14;

inline bool near(const Pose& a, const Pose& b) {
  return (a.inverse() * b).angle() < rounding && (a.position - b.position).norm() < rounding;
}

inline void check_equal(const BodySpec& a, const BodySpec& b) {
  INFO(a.name);
  CHECK(a.material == b.material);
  CHECK(a.mass == b.mass);
  // what a reader mends has its centre and inertia written, where the file left them to the shape
  const bool mended = a.shape && b.shape && !a.shape->closed() && !a.com;
  if (mended)
    CHECK((com_of(a) - com_of(b)).norm() < rounding);
  else
    CHECK(a.com == b.com);
  if (mended && !a.inertia_per_mass)
    CHECK((inertia_of(a) - inertia_of(b)).norm() < rounding * inertia_of(a).norm());
  else
    CHECK(a.inertia_per_mass.has_value() == b.inertia_per_mass.has_value());
  // the original's readers make it symmetric
  if (a.inertia_per_mass && b.inertia_per_mass)
    CHECK((*a.inertia_per_mass - *b.inertia_per_mass).norm() <= 1e-15 * a.inertia_per_mass->norm());
  CHECK(a.elastic_modulus == b.elastic_modulus);
  CHECK(a.tracker == b.tracker);
  REQUIRE((a.shape != nullptr) == (b.shape != nullptr));
  // doubled triangles, which readers of the original's scenes keep, are mended in a mesh file
  if (a.shape && a.shape->faults().duplicate_triangles > 0)
    CHECK(a.shape->mesh().vertices == b.shape->mesh().vertices);
  else if (a.shape)
    CHECK(a.shape->hash() == b.shape->hash());
  const Appearance &looks = a.appearance, &other = b.appearance;
  CHECK(looks.given == other.given);
  // colours are 32-bit; one that is a mean over triangles is summed anew
  CHECK((looks.color - other.color).norm() < 1e-6f);
  CHECK(std::abs(looks.transparency - other.transparency) < 1e-6f);
  CHECK(looks.triangle_colors == other.triangle_colors);
}

inline void check_equal(const DofSpec& a, const DofSpec& b) {
  CHECK(a.kind == b.kind);
  CHECK(a.default_velocity == b.default_velocity);
  CHECK(a.max_effort == b.max_effort);
  CHECK(a.max_velocity == b.max_velocity);
  CHECK(a.kp == b.kp);
  CHECK(a.kd == b.kd);
  CHECK(a.breakaway_torque == b.breakaway_torque);
  CHECK(a.dragger_scale == b.dragger_scale);
}

inline void check_equal(const JointSpec& a, const JointSpec& b) {
  CHECK(a.kind == b.kind);
  CHECK(a.dof == b.dof);
  CHECK(a.ratio == b.ratio);
  CHECK(a.theta == b.theta);
  CHECK(a.d == b.d);
  CHECK(a.a == b.a);
  CHECK(a.alpha == b.alpha);
  CHECK(a.min == b.min);
  CHECK(a.max == b.max);
  CHECK(a.viscous == b.viscous);
  CHECK(a.coulomb == b.coulomb);
  CHECK(a.spring == b.spring);
  CHECK(a.rest == b.rest);
}

inline void check_equal(const EigengraspSet& a, const EigengraspSet& b) {
  CHECK(a.dofs == b.dofs);
  REQUIRE(a.grasps.size() == b.grasps.size());
  for (size_t i = 0; i < a.grasps.size(); ++i) {
    CHECK(a.grasps[i].vector == b.grasps[i].vector);
    CHECK(a.grasps[i].eigenvalue == b.grasps[i].eigenvalue);
    CHECK(a.grasps[i].limits == b.grasps[i].limits);
  }
  CHECK(a.origin == b.origin);
  CHECK(a.norm == b.norm);
}

inline void check_equal(const VirtualContactSet& a, const VirtualContactSet& b) {
  CHECK(a.robot == b.robot);
  REQUIRE(a.contacts.size() == b.contacts.size());
  for (size_t i = 0; i < a.contacts.size(); ++i) {
    CHECK(a.contacts[i].chain == b.contacts[i].chain);
    CHECK(a.contacts[i].link == b.contacts[i].link);
    CHECK(near(a.contacts[i].X_LC, b.contacts[i].X_LC));
    CHECK(a.contacts[i].mu == b.contacts[i].mu);
    CHECK(a.contacts[i].edges == b.contacts[i].edges);
  }
}

inline void check_equal_tendons(const RobotSpec& a, const RobotSpec& b) {
  REQUIRE(a.tactile.size() == b.tactile.size());
  for (size_t i = 0; i < a.tactile.size(); ++i) {
    CHECK(a.tactile[i].part == b.tactile[i].part);
    CHECK(a.tactile[i].low_L == b.tactile[i].low_L);
    CHECK(a.tactile[i].high_L == b.tactile[i].high_L);
  }
  REQUIRE(a.tendons.size() == b.tendons.size());
  for (size_t i = 0; i < a.tendons.size(); ++i) {
    const TendonSpec &x = a.tendons[i], &y = b.tendons[i];
    CHECK(x.name == y.name);
    CHECK(x.stiffness == y.stiffness);
    CHECK(x.rest_length == y.rest_length);
    CHECK(x.pre_tension_length == y.pre_tension_length);
    REQUIRE(x.points.size() == y.points.size());
    for (size_t k = 0; k < x.points.size(); ++k) {
      CHECK(x.points[k].part == y.points[k].part);
      CHECK(x.points[k].p_L == y.points[k].p_L);
      CHECK(x.points[k].friction == y.points[k].friction);
    }
  }
  REQUIRE(a.wrappers.size() == b.wrappers.size());
  for (size_t i = 0; i < a.wrappers.size(); ++i) {
    const TendonWrapper &x = a.wrappers[i], &y = b.wrappers[i];
    CHECK(x.part == y.part);
    CHECK(x.p_L == y.p_L);
    CHECK((x.axis_L - y.axis_L).norm() < rounding);
    CHECK(x.radius == y.radius);
    CHECK(x.length == y.length);
    CHECK(x.friction == y.friction);
    CHECK(x.exempt == y.exempt);
    REQUIRE(x.sides.size() == y.sides.size());
    for (size_t k = 0; k < x.sides.size(); ++k) {
      CHECK(x.sides[k].tendon == y.sides[k].tendon);
      CHECK((x.sides[k].direction_L - y.sides[k].direction_L).norm() < rounding);
    }
  }
}

inline void check_equal_chains(const RobotSpec& a, const RobotSpec& b) {
  REQUIRE(a.chains.size() == b.chains.size());
  for (size_t c = 0; c < a.chains.size(); ++c) {
    INFO("chain " << c);
    const ChainSpec &x = a.chains[c], &y = b.chains[c];
    CHECK(x.parent_chain == y.parent_chain);
    CHECK(x.X_BC == y.X_BC);
    REQUIRE(x.joints.size() == y.joints.size());
    for (size_t j = 0; j < x.joints.size(); ++j) check_equal(x.joints[j], y.joints[j]);
    REQUIRE(x.links.size() == y.links.size());
    for (size_t l = 0; l < x.links.size(); ++l) {
      CHECK(x.links[l].joint == y.links[l].joint);
      CHECK(x.links[l].last_joint == y.links[l].last_joint);
      check_equal(x.links[l].body, y.links[l].body);
    }
  }
}

/// All that a .cfg holds.
inline void check_equal_cfg(const RobotSpec& a, const RobotSpec& b) {
  CHECK(a.class_name == b.class_name);
  check_equal(a.base, b.base);
  REQUIRE(a.dofs.size() == b.dofs.size());
  for (size_t d = 0; d < a.dofs.size(); ++d) check_equal(a.dofs[d], b.dofs[d]);
  check_equal_chains(a, b);
  CHECK(a.chain_links_collide == b.chain_links_collide);
  REQUIRE(a.X_BA.has_value() == b.X_BA.has_value());
  if (a.X_BA) CHECK(near(*a.X_BA, *b.X_BA));
  REQUIRE(a.eigengrasps.has_value() == b.eigengrasps.has_value());
  if (a.eigengrasps) check_equal(*a.eigengrasps, *b.eigengrasps);
  REQUIRE(a.virtual_contacts.has_value() == b.virtual_contacts.has_value());
  if (a.virtual_contacts) check_equal(*a.virtual_contacts, *b.virtual_contacts);
  REQUIRE(a.glove.has_value() == b.glove.has_value());
  if (a.glove) CHECK(a.glove->slopes == b.glove->slopes);
  if (a.glove) CHECK(a.glove->intercepts == b.glove->intercepts);
  REQUIRE(a.tracker.has_value() == b.tracker.has_value());
  if (a.tracker) CHECK(a.tracker->number == b.tracker->number);
  if (a.tracker) CHECK(a.tracker->X_BS == b.tracker->X_BS);
}

/// All that an .xml holds.
inline void check_equal_xml(const RobotSpec& a, const RobotSpec& b) {
  check_equal_cfg(a, b);
  CHECK(a.database_name == b.database_name);
  for (size_t d = 0; d < a.dofs.size(); ++d)
    CHECK(a.dofs[d].default_value == b.dofs[d].default_value);
  CHECK(a.collision_rules.parts_off == b.collision_rules.parts_off);
  CHECK(a.collision_rules.pairs_off == b.collision_rules.pairs_off);
  CHECK(a.collision_rules.near_pairs_off == b.collision_rules.near_pairs_off);
  check_equal_tendons(a, b);
}

}  // namespace clench::test
