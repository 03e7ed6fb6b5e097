// Wrench sets of all kinds that are hard for hull algorithms, for tests and benchmarks: symmetric,
// coplanar, repeated, nearly repeated, flat, thin, marginal, of many sizes. A kind and a number
// identify each set.
#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "clench/base/random.h"
#include "clench/grasp/wrench/wrench_space.h"

namespace clench::test {

inline constexpr int wrench_set_kinds = 16;

inline const char* wrench_set_kind(int kind) {
  static constexpr const char* names[wrench_set_kinds] = {"random grasp",
                                                          "ring",
                                                          "box",
                                                          "tetrahedron",
                                                          "octahedron",
                                                          "repeated contacts",
                                                          "nearly repeated contacts",
                                                          "lattice",
                                                          "corners of a cube",
                                                          "thin",
                                                          "of many sizes",
                                                          "two faces",
                                                          "marginal",
                                                          "cross and cube",
                                                          "cylinder",
                                                          "soft fingers"};
  return names[kind];
}

inline Eigen::Vector3d random_unit_vector(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

inline int pick(Random& random, int low, int high) {
  return low + static_cast<int>(random.bits() % static_cast<uint64_t>(high - low + 1));
}

/// A random contact on a roughly round object of radius one.
inline PointContact random_contact(Random& random, double mu) {
  const Eigen::Vector3d n = random_unit_vector(random);
  return {.p_O = -n + 0.3 * random_unit_vector(random), .n_O = n, .mu = mu};
}

inline Wrenches random_normal_wrenches(Random& random, int count) {
  Wrenches out(6, count);
  for (double& x : out.reshaped()) x = random.normal();
  return out;
}

/// contacts that press on the unit ball from the given directions
inline std::vector<PointContact> ball_contacts(const std::vector<Eigen::Vector3d>& directions,
                                               double mu) {
  std::vector<PointContact> out;
  for (const Eigen::Vector3d& d : directions)
    out.push_back({.p_O = d.normalized(), .n_O = -d.normalized(), .mu = mu});
  return out;
}

inline std::vector<Eigen::Vector3d> ring_directions(int count) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    out.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return out;
}

/// vertices of a tetrahedron, an octahedron or a cube: 4, 6 or 8 directions
inline std::vector<Eigen::Vector3d> solid_directions(int count) {
  std::vector<Eigen::Vector3d> out;
  if (count == 6) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {1, -1}) out.push_back(side * Eigen::Vector3d::Unit(axis));
    return out;
  }
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    if (count == 8 || corner.prod() > 0) out.push_back(corner);
  }
  return out;
}

/// four contacts near the corners of each of `faces` faces of a cube
inline std::vector<PointContact> box_contacts(int faces, double half, double mu) {
  std::vector<PointContact> out;
  for (int face = 0; face < faces; ++face) {
    const int axis = face / 2;
    const Eigen::Vector3d n = (face % 2 ? 1 : -1) * Eigen::Vector3d::Unit(axis);
    for (int i = 0; i < 4; ++i) {
      Eigen::Vector3d p = -n;
      p[(axis + 1) % 3] = i & 1 ? half : -half;
      p[(axis + 2) % 3] = i & 2 ? half : -half;
      out.push_back({.p_O = p, .n_O = n, .mu = mu});
    }
  }
  return out;
}

inline std::vector<Wrenches> wrenches_of(const std::vector<PointContact>& contacts, int edges) {
  std::vector<Wrenches> out;
  for (const PointContact& contact : contacts)
    out.push_back(cone_wrenches(contact, {.edges = edges}));
  return out;
}

inline Wrenches side_by_side(const std::vector<Wrenches>& contacts) {
  Eigen::Index count = 0, column = 0;
  for (const Wrenches& w : contacts) count += w.cols();
  Wrenches out(6, count);
  for (const Wrenches& w : contacts) {
    out.middleCols(column, w.cols()) = w;
    column += w.cols();
  }
  return out;
}

/// Half of all sets are turned at random.
inline std::vector<Wrenches> wrench_set(int kind, uint64_t number) {
  Random random(static_cast<uint64_t>(kind) + 1, number);
  constexpr double mus[] = {0, 0.1, 0.5, 0.8, 1, 2};
  const double mu = mus[pick(random, 0, 5)];
  const int edges = pick(random, 3, 16);
  std::vector<Wrenches> out;
  switch (kind) {
    case 0: {
      std::vector<PointContact> contacts(pick(random, 2, 10));
      for (auto& c : contacts) c = random_contact(random, random.uniform(0.1, 1));
      out = wrenches_of(contacts, edges);
      break;
    }
    case 1:
      out = wrenches_of(ball_contacts(ring_directions(pick(random, 2, 8)), mu), 8);
      break;
    case 2:
      out = wrenches_of(box_contacts(pick(random, 2, 6), random.uniform(0.1, 1), mu),
                        pick(random, 0, 1) ? 8 : 4);
      break;
    case 3:
      out = wrenches_of(ball_contacts(solid_directions(4), mu), edges);
      break;
    case 4:
      out = wrenches_of(ball_contacts(solid_directions(6), mu), edges);
      break;
    case 5:
    case 6: {
      std::vector<PointContact> contacts(pick(random, 2, 6));
      for (auto& c : contacts) c = random_contact(random, 0.6);
      out = wrenches_of(contacts, 8);
      const size_t count = out.size();
      for (size_t i = 0; i < count; ++i) {
        Wrenches again = out[random.bits() % count];
        if (kind == 6)
          again += std::pow(10, -random.uniform(6, 16)) *
                   random_normal_wrenches(random, static_cast<int>(again.cols()));
        out.push_back(again);
      }
      break;
    }
    case 7:
      out = {Wrenches(random_normal_wrenches(random, pick(random, 7, 64)).array().round())};
      break;
    case 8:
      out = {Wrenches(random_normal_wrenches(random, pick(random, 7, 64)).array().sign())};
      break;
    case 9:
      out = {random_normal_wrenches(random, pick(random, 7, 64))};
      out[0].row(pick(random, 0, 5)) *= std::pow(10, -random.uniform(0, 12));
      break;
    case 10:
      out = {random_normal_wrenches(random, pick(random, 7, 64))};
      for (auto column : out[0].colwise()) column *= std::pow(10, -random.uniform(0, 16));
      break;
    case 11: {
      std::vector<PointContact> contacts;
      const auto ring = ring_directions(pick(random, 3, 12));
      for (size_t i = 0; i < ring.size(); ++i) {
        const double side = i % 2 ? 1 : -1;
        contacts.push_back({.p_O = 0.7 * ring[i] + Eigen::Vector3d(0, 0, 0.5 * side),
                            .n_O = {0, 0, -side},
                            .mu = 0.5});
      }
      out = wrenches_of(contacts, 8);
      break;
    }
    case 12: {
      // the normals are inclined by almost the friction angle
      const double lean = random.uniform(0, 0.5);
      const double off = std::pow(10, -random.uniform(3, 15)) * (pick(random, 0, 1) ? 1 : -1);
      std::vector<PointContact> contacts;
      for (const Eigen::Vector3d& d : ring_directions(3))
        contacts.push_back({.p_O = -d,
                            .n_O = (d + Eigen::Vector3d(0, 0, std::tan(lean))).normalized(),
                            .mu = std::max(0.0, std::tan(lean) + off)});
      out = wrenches_of(contacts, 8);
      break;
    }
    case 13: {
      Wrenches cross(6, 12);
      cross << Eigen::Matrix<double, 6, 6>::Identity(), -Eigen::Matrix<double, 6, 6>::Identity();
      out = {cross};
      if (pick(random, 0, 1)) {
        Wrenches cube(6, 64);
        for (int i = 0; i < 64; ++i)
          for (int row = 0; row < 6; ++row) cube(row, i) = (i >> row & 1) ? 0.5 : -0.5;
        out.push_back(cube);
      }
      break;
    }
    case 14: {
      std::vector<PointContact> contacts;
      const auto ring = ring_directions(4);
      const int count = pick(random, 4, 16);
      for (int i = 0; i < count; ++i)
        contacts.push_back({.p_O = ring[i % 4] + Eigen::Vector3d(0, 0, 0.2 * (i / 4)),
                            .n_O = -ring[i % 4],
                            .mu = 0.5});
      out = wrenches_of(contacts, 8);
      break;
    }
    default: {
      std::vector<PointContact> contacts;
      const int count = pick(random, 2, 5);
      const bool opposed = pick(random, 0, 1) == 1;
      for (int i = 0; i < count; ++i) {
        PointContact c = random_contact(random, 0.7);
        if (opposed && i < 2) {
          c.n_O = {i ? 1.0 : -1.0, 0, 0};
          c.p_O = -c.n_O;
        }
        c.torsion_radius = 0.1;
        contacts.push_back(c);
      }
      out = wrenches_of(contacts, 8);
    }
  }
  if (pick(random, 0, 1)) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
            .normalized()
            .toRotationMatrix();
    for (Wrenches& w : out) {
      w.topRows(3) = (turn * w.topRows(3)).eval();
      w.bottomRows(3) = (turn * w.bottomRows(3)).eval();
    }
  }
  return out;
}

}  // namespace clench::test
