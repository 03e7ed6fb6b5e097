#include "clench/render/mesh/corner_normals.h"

#include <Eigen/Geometry>
#include <cmath>

#include "clench/base/watched.h"

namespace clench {
namespace {

// the center of a large fan is not smoothed: that has quadratic cost and no visible effect
constexpr int max_neighbors = 128;

Eigen::Vector3d face_normal(const std::vector<Eigen::Vector3d>& vertices, const Triangle& t) {
  const Eigen::Vector3d a = vertices[t[1]] - vertices[t[0]], b = vertices[t[2]] - vertices[t[0]];
  const Eigen::Vector3d n = a.cross(b);
  const double length = n.norm();
  // a triangle thinner than 10^-12 of its edges has no meaningful direction
  if (!(length > 1e-12 * (a.squaredNorm() + b.squaredNorm()))) return Eigen::Vector3d::Zero();
  return n / length;
}

double angle_at(const std::vector<Eigen::Vector3d>& vertices, const Triangle& t, int corner) {
  const Eigen::Vector3d& p = vertices[t[corner]];
  const Eigen::Vector3d a = vertices[t[(corner + 1) % 3]] - p,
                        b = vertices[t[(corner + 2) % 3]] - p;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(
    const std::vector<Eigen::Vector3d>& vertices, const std::vector<Triangle>& triangles,
    double crease) {
  const int count = static_cast<int>(triangles.size());
  std::vector<Eigen::Vector3d> faces(count);
  std::vector<int> first(vertices.size() + 1, 0);
  StopCheck check(1 << 12);
  for (int i = 0; i < count; ++i) {
    check();
    faces[i] = face_normal(vertices, triangles[i]);
    for (const int v : triangles[i]) ++first[v + 1];
  }

  // corners by vertex, in the order of the triangles
  for (size_t v = 0; v + 1 < first.size(); ++v) first[v + 1] += first[v];
  std::vector<int> around(3 * triangles.size()), next(first.begin(), first.end() - 1);
  std::vector<double> weights(3 * triangles.size());
  for (int i = 0; i < count; ++i) {
    check();
    for (int k = 0; k < 3; ++k) {
      around[next[triangles[i][k]]++] = i;
      weights[3 * i + k] = angle_at(vertices, triangles[i], k);
    }
  }

  const double least = std::cos(crease);
  std::vector<std::array<Eigen::Vector3f, 3>> normals(count);
  for (int i = 0; i < count; ++i) {
    check();
    for (int k = 0; k < 3; ++k) {
      const int v = triangles[i][k];
      Eigen::Vector3d sum = faces[i];
      if (first[v + 1] - first[v] <= max_neighbors) {
        sum.setZero();
        for (int at = first[v]; at < first[v + 1]; ++at) {
          const int j = around[at], corner = triangles[j][0] == v   ? 0
                                             : triangles[j][1] == v ? 1
                                                                    : 2;
          const double lean = faces[i].dot(faces[j]);
          if (std::abs(lean) >= least)
            sum += std::copysign(weights[3 * j + corner], lean) * faces[j];
        }
      }
      const double length = sum.norm();
      normals[i][k] = (length > 1e-9 ? Eigen::Vector3d(sum / length) : faces[i]).cast<float>();
    }
  }
  return normals;
}

}  // namespace clench
