#include "clench/geometry/mesh/ball.h"

#include <cmath>
#include <numbers>

#include "clench/math/decompositions.h"

namespace clench {

std::optional<Sphere> ball_of(const Mesh& mesh, double volume) {
  constexpr double filled = 0.95, exact = 1e-6;
  const Bounds bounds = mesh.bounds();
  const Eigen::Vector3d size = bounds.size();
  // most meshes are told apart by their box
  if (!(volume > 0) || size.minCoeff() < 0.9 * size.maxCoeff() || mesh.vertices.size() < 12)
    return std::nullopt;
  // |v|^2 = 2 c.v + (r^2 - |c|^2), by least squares about the middle of the box
  const Eigen::Vector3d middle = bounds.centre();
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Vector3d v = vertex - middle;
    const Eigen::Vector4d row(2 * v.x(), 2 * v.y(), 2 * v.z(), 1);
    A += row * row.transpose();
    b += v.squaredNorm() * row;
  }
  const Eigen::Vector4d x = A.ldlt().solve(b);
  const Eigen::Vector3d centre = x.head<3>();
  const double radius = std::sqrt(x[3] + centre.squaredNorm());
  if (!(radius > 0) || volume < filled * 4 / 3 * std::numbers::pi * radius * radius * radius)
    return std::nullopt;
  for (const Eigen::Vector3d& v : mesh.vertices)
    if (std::abs((v - middle - centre).norm() - radius) > exact * radius) return std::nullopt;
  return Sphere{middle + centre, radius};
}

}  // namespace clench
