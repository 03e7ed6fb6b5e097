// Random meshes and poses, meshes joined and moved, and a reader for scanned ones.
#pragma once
#include <filesystem>
#include <fstream>
#include <sstream>

#include "clench/base/random.h"
#include "clench/geometry/tree/shape.h"
#include "clench/math/pose.h"
#include "support/shapes.h"

namespace clench::test {

inline Eigen::Vector3d random_point(Random& random, double size = 1) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return size * Eigen::Vector3d(x, y, z);
}

inline Eigen::Vector3d random_direction(Random& random) {
  return random_point(random).normalized();
}

inline Eigen::Quaterniond random_turn(Random& random) {
  const double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

/// random rotation, and a position of at most `reach` along each axis [m]
inline Pose random_pose(Random& random, double reach) {
  const Eigen::Quaterniond turn = random_turn(random);
  const double x = random.uniform(-reach, reach), y = random.uniform(-reach, reach),
               z = random.uniform(-reach, reach);
  return {turn, {x, y, z}};
}

/// Triangles at random positions within a unit box, not connected; every fifth one is degenerate.
inline Mesh soup(Random& random, int count, double size = 0.2) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d center = random_pose(random, 0.5).position;
    std::array<Eigen::Vector3d, 3> c;
    for (auto& p : c) p = center + random_point(random, size);
    if (i % 15 == 4) c[2] = c[1];
    if (i % 15 == 9) c[2] = 0.25 * c[0] + 0.75 * c[1];
    if (i % 15 == 14) c[1] = c[2] = c[0];
    for (const auto& p : c) mesh.vertices.push_back(p);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

/// A closed surface without symmetry: a ball with random displacements of its vertices.
inline Mesh potato(Random& random, double radius = 1, int rings = 10) {
  Mesh mesh = ball(radius, rings, 2 * rings - 1);
  for (auto& p : mesh.vertices) p *= random.uniform(0.75, 1.25);
  return mesh;
}

inline Mesh moved(Mesh mesh, const Pose& X) {
  for (auto& p : mesh.vertices) p = X * p;
  return mesh;
}

inline Mesh scaled(Mesh mesh, double factor) {
  for (auto& p : mesh.vertices) p *= factor;
  return mesh;
}

/// the same surface with inside and outside exchanged
inline Mesh inverted(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline Mesh joined(Mesh a, const Mesh& b) {
  const int offset = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles)
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

/// Vertices and triangular faces of an OBJ file; all other lines are ignored.
inline Mesh read_obj(const std::filesystem::path& path) {
  std::ifstream file(path);
  Mesh mesh;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Eigen::Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      mesh.vertices.push_back(p);
    } else if (kind == "f") {
      Triangle t;
      std::string corner;
      for (int& v : t) words >> corner, v = std::stoi(corner) - 1;
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

/// Winding number of the mesh about p, by solid angles: slow and simple.
/// source  van Oosterom & Strackee (1983)
inline double winding(const Mesh& mesh, const Eigen::Vector3d& p) {
  double sum = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    auto c = mesh.corners(static_cast<int>(i));
    for (auto& x : c) x = (x - p).normalized();
    sum += 2 * std::atan2(c[0].dot(c[1].cross(c[2])),
                          1 + c[0].dot(c[1]) + c[1].dot(c[2]) + c[2].dot(c[0]));
  }
  return sum / (4 * std::numbers::pi);
}

/// Triangle of b at X_AB in the frame of a.
inline std::array<Eigen::Vector3d, 3> corners_at(const Shape& b, const Pose& X_AB, int triangle) {
  auto c = b.mesh().corners(triangle);
  for (auto& p : c) p = X_AB * p;
  return c;
}

}  // namespace clench::test
