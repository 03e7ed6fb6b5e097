#include "clench/geometry/mesh/mass.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "clench/base/watched.h"

namespace clench {

using Eigen::Matrix3d;
using Eigen::Vector3d;

MassProperties solid_mass(const Mesh& mesh) {
  MassProperties out;
  const Bounds bounds = mesh.bounds();
  if (bounds.empty()) return out;

  // signed tetrahedra over the triangles, from a nearby apex so that a distant origin costs no
  // digits
  const Vector3d apex = bounds.center();
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  StopCheck check(1 << 14);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    check();
    auto c = mesh.corners(static_cast<int>(i));
    for (Vector3d& p : c) p -= apex;
    const double v = c[0].dot(c[1].cross(c[2])) / 6;
    const Vector3d sum = c[0] + c[1] + c[2];
    volume += v;
    first += v / 4 * sum;
    second += v / 20 * (sum * sum.transpose());
    for (const Vector3d& p : c) second += v / 20 * (p * p.transpose());
  }
  out.volume = volume;

  // a sheet has no center of volume: that of its surface is used
  if (!(std::abs(volume) > 1e-14 * mesh.area() * bounds.size().maxCoeff())) {
    out.centroid = surface_centroid(mesh);
    return out;
  }
  const Vector3d center = first / volume;
  const Matrix3d spread = second / volume - center * center.transpose();
  out.centroid = apex + center;
  out.inertia = spread.trace() * Matrix3d::Identity() - spread;
  return out;
}

bool turn_outward(Mesh& mesh) {
  if (!(solid_mass(mesh).volume < 0) || !find_faults(mesh).closed()) return false;
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return true;
}

Vector3d surface_centroid(const Mesh& mesh) {
  const Bounds bounds = mesh.bounds();
  if (bounds.empty()) return Vector3d::Zero();
  const Vector3d origin = bounds.center();
  double area = 0;
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto c = mesh.corners(static_cast<int>(i));
    const double a = (c[1] - c[0]).cross(c[2] - c[0]).norm();
    area += a;
    sum += a / 3 * ((c[0] - origin) + (c[1] - origin) + (c[2] - origin));
  }
  return area > 0 ? Vector3d(origin + sum / area) : origin;
}

double largest_radius(const Mesh& mesh, const Vector3d& p) {
  // the farthest point of a triangle is a corner
  double squared = 0;
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) squared = std::max(squared, (mesh.vertices[v] - p).squaredNorm());
  return std::sqrt(squared);
}

}  // namespace clench
