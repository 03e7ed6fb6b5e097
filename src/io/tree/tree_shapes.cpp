#include "clench/io/tree/tree_shapes.h"

#include <cmath>
#include <numbers>

namespace clench {

Mesh box_mesh(const Eigen::Vector3d& size) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        0.5 * size.cwiseProduct(Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

namespace {

/// A circle about z on the surface.
struct LatheRing {
  double radius = 0, z = 0;
};

/// The surface of rings from the lower to the upper bound, with a point at each end.
Mesh turned(const std::vector<LatheRing>& rings, double lowest, double highest) {
  Mesh mesh;
  const int n = circle_edges, count = static_cast<int>(rings.size());
  for (const LatheRing& ring : rings)
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      mesh.vertices.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle),
                                 ring.z);
    }
  const int bottom = n * count, top = bottom + 1;
  mesh.vertices.emplace_back(0, 0, lowest);
  mesh.vertices.emplace_back(0, 0, highest);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.triangles.push_back({bottom, next, i});
    for (int r = 0; r + 1 < count; ++r) {
      const int a = r * n, b = a + n;
      mesh.triangles.push_back({a + i, a + next, b + next});
      mesh.triangles.push_back({a + i, b + next, b + i});
    }
    const int last = (count - 1) * n;
    mesh.triangles.push_back({top, last + i, last + next});
  }
  return mesh;
}

}  // namespace

Mesh cylinder_mesh(double radius, double length) {
  return turned({{radius, -length / 2}, {radius, length / 2}}, -length / 2, length / 2);
}

Mesh capsule_mesh(double radius, double length) {
  const int quarter = circle_edges / 4;
  std::vector<LatheRing> rings;
  for (int k = 1; k <= quarter; ++k) {
    const double angle = std::numbers::pi / 2 * k / quarter;
    rings.push_back({radius * std::sin(angle), -length / 2 - radius * std::cos(angle)});
  }
  rings.back() = {radius, -length / 2};
  // the upper half mirrors the lower one; a ball has only one equator
  for (int k = quarter - (length > 0 ? 0 : 1); k >= 1; --k)
    rings.push_back({rings[k - 1].radius, -rings[k - 1].z});
  return turned(rings, -length / 2 - radius, length / 2 + radius);
}

Mesh ellipsoid_mesh(const Eigen::Vector3d& radii) {
  Mesh mesh = capsule_mesh(1, 0);
  for (auto& p : mesh.vertices) p = p.cwiseProduct(radii);
  return mesh;
}

static MassProperties solid(double volume, const Eigen::Vector3d& moments) {
  MassProperties out;
  out.volume = volume;
  out.inertia = moments.asDiagonal();
  return out;
}

MassProperties cylinder_solid(double radius, double length) {
  const double r2 = radius * radius, across = r2 / 4 + length * length / 12;
  return solid(std::numbers::pi * r2 * length, {across, across, r2 / 2});
}

MassProperties capsule_solid(double radius, double length) {
  const MassProperties middle = cylinder_solid(radius, length);
  const double r2 = radius * radius, ball = 4.0 / 3 * std::numbers::pi * r2 * radius;
  const double volume = middle.volume + ball, part = ball / volume;
  // hemispheres, whose centers of mass are 3/8 r beyond the ends
  const double along = 0.4 * r2, across = along + length * length / 4 + 3.0 / 8 * length * radius;
  const Eigen::Vector3d ends(across, across, along);
  return solid(volume, (1 - part) * middle.inertia.diagonal() + part * ends);
}

MassProperties ellipsoid_solid(const Eigen::Vector3d& radii) {
  const Eigen::Vector3d squares = radii.cwiseAbs2();
  return solid(4.0 / 3 * std::numbers::pi * radii.prod(),
               (Eigen::Vector3d::Constant(squares.sum()) - squares) / 5);
}

MassProperties box_shell(const Eigen::Vector3d& size) {
  // pairs of faces, by the axis between them
  const Eigen::Vector3d areas(size.y() * size.z(), size.z() * size.x(), size.x() * size.y());
  const double area = 2 * areas.sum();
  const Eigen::Vector3d squares = size.cwiseAbs2();
  Eigen::Vector3d second = Eigen::Vector3d::Zero();  // mean squares of coordinates
  for (int face = 0; face < 3; ++face)
    for (int axis = 0; axis < 3; ++axis)
      second[axis] += 2 * areas[face] / area * squares[axis] / (axis == face ? 4 : 12);
  return solid(area, Eigen::Vector3d::Constant(second.sum()) - second);
}

MassProperties cylinder_shell(double radius, double length) {
  const double side = 2 * std::numbers::pi * radius * length,
               ends = 2 * std::numbers::pi * radius * radius, area = side + ends;
  const double r2 = radius * radius, l2 = length * length;
  const Eigen::Vector3d of_side(r2 / 2 + l2 / 12, r2 / 2 + l2 / 12, r2);
  const Eigen::Vector3d of_ends(r2 / 4 + l2 / 4, r2 / 4 + l2 / 4, r2 / 2);
  return solid(area, (side * of_side + ends * of_ends) / area);
}

MassProperties capsule_shell(double radius, double length) {
  const double side = 2 * std::numbers::pi * radius * length,
               ball = 4 * std::numbers::pi * radius * radius, area = side + ball;
  const double r2 = radius * radius, l2 = length * length;
  const Eigen::Vector3d of_side(r2 / 2 + l2 / 12, r2 / 2 + l2 / 12, r2);
  // hemispherical shells, whose centers of mass are half a radius beyond the ends
  const double across = 2.0 / 3 * r2 + l2 / 4 + length * radius / 2;
  const Eigen::Vector3d of_ball(across, across, 2.0 / 3 * r2);
  return solid(area, (side * of_side + ball * of_ball) / area);
}

MassProperties ellipsoid_shell(const Eigen::Vector3d& radii) {
  constexpr double p = 1.6075;
  const double a = radii.x(), b = radii.y(), c = radii.z();
  const double mean = (std::pow(a * b, p) + std::pow(b * c, p) + std::pow(c * a, p)) / 3;
  const double area = 4 * std::numbers::pi * std::pow(mean, 1 / p);
  // the derivative of the solid's moments when all radii grow equally
  const Eigen::Vector3d squares = radii.cwiseAbs2();
  const double share = 2 * a * b * c / (a * b + b * c + c * a);
  const Eigen::Vector3d moments = (Eigen::Vector3d::Constant(squares.sum()) - squares +
                                   share * (Eigen::Vector3d::Constant(radii.sum()) - radii)) /
                                  5;
  return solid(area, moments);
}

}  // namespace clench
