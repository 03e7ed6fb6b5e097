#include "clench/io/mjcf/geoms/mjcf_mesh_mass.h"

#include <cmath>

#include "clench/geometry/mesh/hull.h"
#include "clench/geometry/mesh/principal_axes.h"

namespace clench {

namespace {

struct Corners {
  Eigen::Vector3d a, b, c;
  Eigen::Vector3d mean() const { return (a + b + c) / 3; }
  double area() const { return (b - a).cross(c - a).norm() / 2; }
};

/// Calls visit(corners) for each triangle.
template <class Visit>
void each_triangle(const Mesh& mesh, Visit visit) {
  for (const Triangle& t : mesh.triangles)
    visit(Corners{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
}

/// Six times the volume of the pyramid between a triangle and a point, > 0 if the triangle faces
/// away from the point.
double signed_volume6(const Corners& t, const Eigen::Vector3d& apex) {
  return (t.a - apex).dot((t.b - apex).cross(t.c - apex));
}

/// Second moments of a uniform mass on the simplex of the corners and, for a solid, the origin:
/// integral of x x^T = mass / divisor * this, divisor 20 for a solid and 12 for a surface.
Eigen::Matrix3d corner_moments(const Corners& t) {
  const Eigen::Vector3d sum = t.a + t.b + t.c;
  return t.a * t.a.transpose() + t.b * t.b.transpose() + t.c * t.c.transpose() +
         sum * sum.transpose();
}

Eigen::Matrix3d inertia_of_moments(const Eigen::Matrix3d& moments) {
  return moments.trace() * Eigen::Matrix3d::Identity() - moments;
}

Corners moved(const Corners& t, const Eigen::Vector3d& origin) {
  return {t.a - origin, t.b - origin, t.c - origin};
}

/// Counts all pyramids as positive: first about the centroid of the surface, then about the
/// resulting center of mass.
MassProperties legacy_mass(const Mesh& mesh) {
  MassProperties out;
  const Eigen::Vector3d apex = surface_centroid(mesh);
  double volume = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  each_triangle(mesh, [&](const Corners& t) {
    const double part = std::abs(signed_volume6(t, apex)) / 6;
    volume += part;
    moment += part * (0.75 * t.mean() + 0.25 * apex);
  });
  if (!(volume > 0)) return out;
  out.centroid = moment / volume;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  each_triangle(mesh, [&](const Corners& t) {
    const Corners own = moved(t, out.centroid);
    const double part = std::abs(signed_volume6(own, Eigen::Vector3d::Zero())) / 6;
    out.volume += part;
    moments += part / 20 * corner_moments(own);
  });
  if (out.volume > 0) out.inertia = inertia_of_moments(moments) / out.volume;
  return out;
}

MassProperties shell_mass(const Mesh& mesh) {
  MassProperties out;
  const Eigen::Vector3d apex = surface_centroid(mesh);
  // for a shell, MuJoCo's center of mass is the centroid of the surface
  out.centroid = apex;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  each_triangle(mesh, [&](const Corners& t) {
    const double area = t.area();
    out.volume += area;
    moments += area / 12 * corner_moments(moved(t, apex));
  });
  if (out.volume > 0) out.inertia = inertia_of_moments(moments) / out.volume;
  return out;
}

MassProperties solid(const Mesh& mesh) {
  MassProperties out = solid_mass(mesh);
  out.volume = std::abs(out.volume);
  return out;
}

Mesh hull_of(const Mesh& mesh) {
  Eigen::MatrixXd points(3, mesh.vertices.size());
  for (size_t i = 0; i < mesh.vertices.size(); ++i) points.col(i) = mesh.vertices[i];
  const Hull hull = convex_hull(points);
  Mesh out;
  if (!hull.full()) return out;
  out.vertices = mesh.vertices;
  out.triangles = hull_triangles(hull, points);
  return out;
}

}  // namespace

MassProperties mesh_mass(const Mesh& mesh, MeshInertia rule) {
  if (rule == MeshInertia::shell) return shell_mass(mesh);
  if (rule == MeshInertia::exact) return solid(mesh);
  if (rule == MeshInertia::convex) return solid(hull_of(mesh));
  constexpr double rounding = 1e-9;
  const MassProperties exact = solid(mesh), legacy = legacy_mass(mesh);
  return std::abs(exact.volume - legacy.volume) <= rounding * legacy.volume ? exact : legacy;
}

InertiaAxes inertia_axes(const Eigen::Matrix3d& inertia) {
  const Eigen::Matrix3d ascending = principal_axes(inertia);
  Eigen::Matrix3d axes;
  axes << ascending.col(2), ascending.col(1), -ascending.col(0);
  return {Eigen::Quaterniond(axes).normalized(), (axes.transpose() * inertia * axes).diagonal()};
}

}  // namespace clench
