#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/ray.h"

namespace clench {

using Eigen::Vector3d;

namespace {

// Winding number of the surface about p, counter-clockwise from outside: solid angles over 4 pi.
// source  van Oosterom & Strackee (1983)
double winding_by_angles(const Mesh& mesh, const Vector3d& p) {
  double sum = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    auto c = mesh.corners(static_cast<int>(i));
    for (Vector3d& corner : c) corner -= p;
    const double la = c[0].norm(), lb = c[1].norm(), lc = c[2].norm();
    const double triple = c[0].dot((c[1] - c[0]).cross(c[2] - c[0]));
    const double below =
        la * lb * lc + c[0].dot(c[1]) * lc + c[1].dot(c[2]) * la + c[2].dot(c[0]) * lb;
    sum += 2 * std::atan2(triple, below);
  }
  return sum / (4 * std::numbers::pi);
}

// The same by crossings of one ray: exits minus entries. Empty if the ray passes so near to an
// edge, or p lies so near to a triangle, that rounding would decide.
std::optional<int> winding_by_ray(const Shape& shape, const Vector3d& p,
                                  const Vector3d& direction) {
  const Ray ray(p, direction);
  int winding = 0;
  const double far = std::numeric_limits<double>::infinity();
  const bool unsure = ray.for_near_triangles(shape, far, [&](int triangle) {
    const Crossing c = ray.cross(shape.mesh().corners(triangle), 1e-14);
    if (c.kind == Crossing::Kind::hit && c.distance > 0) winding += c.side;
    return c.kind == Crossing::Kind::unsure;
  });
  if (unsure) return {};
  return winding;
}

}  // namespace

bool contains(const Shape& shape, const Vector3d& p) {
  if (!p.allFinite())
    fail("contains: point must be finite [m], got ({}, {}, {})", p.x(), p.y(), p.z());
  if (!shape.closed() || !shape.bounds().holds(p)) return false;
  // directions that are unlikely symmetries of a model
  for (const Vector3d& d : {Vector3d(0.267, 0.535, 0.802), Vector3d(-0.713, 0.211, 0.671),
                            Vector3d(0.149, -0.947, -0.283)})
    if (const auto winding = winding_by_ray(shape, p, d.normalized())) return *winding != 0;
  return std::abs(winding_by_angles(shape.mesh(), p)) > 0.5;
}

}  // namespace clench
