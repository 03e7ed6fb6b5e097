#include "clench/dynamics/contact/sliding.h"

#include <algorithm>

#include "clench/contact/near_points.h"
#include "clench/geometry/query/round_pairs.h"
#include "clench/model/near_bodies.h"

namespace clench {

using Eigen::Vector3d;

// Is the foot of a perpendicular on the triangle's plane inside it, not on its border?
static bool is_inside(const Vector3d& p, const Corners& c, const Vector3d& normal) {
  for (int k = 0; k < 3; ++k)
    if (!((c[(k + 1) % 3] - c[k]).cross(p - c[k]).dot(normal) > 0)) return false;
  return true;
}

bool follow_sliding(const World& world, Manifold& m) {
  if (m.points.empty()) return false;
  const Body &a = world.body(m.a), &b = world.body(m.b);
  const bool face_of_a = m.points[0].feature_a.kind == Feature::triangle;
  const Shape &face = *(face_of_a ? a : b).shape, &other = *(face_of_a ? b : a).shape;
  constexpr size_t max_vertices = 4096;  // all are examined in every step
  if (are_round(*a.shape, *b.shape, RoundIn::motion) || !face.convex() ||
      other.mesh().vertices.size() > max_vertices || a.elastic_modulus || b.elastic_modulus)
    return false;

  const Pose X_AB = relative_pose(world, m.a, m.b), X_FV = face_of_a ? X_AB : X_AB.inverse();
  const auto& vertices = other.mesh().vertices;
  const auto corner_of = [&](const ManifoldPoint& p) -> const Vector3d& {
    return vertices[(face_of_a ? p.feature_b : p.feature_a).first];
  };
  const double threshold = world.contact_threshold();
  Vector3d normal = Vector3d::Zero();
  Corners corners;
  int triangle = -1;
  double offset = 0;
  for (const ManifoldPoint& p : m.points) {
    const Feature &f = face_of_a ? p.feature_a : p.feature_b,
                  &v = face_of_a ? p.feature_b : p.feature_a;
    if (f.kind != Feature::triangle || v.kind != Feature::vertex) return false;
    if (f.first != triangle) {
      corners = face.mesh().corners(f.first);
      const Vector3d n = face_normal(corners);
      constexpr double one_face = 1 - 1e-12;
      if (triangle >= 0 && n.dot(normal) < one_face) return false;
      if (triangle < 0) normal = n, offset = n.dot(corners[0]);
      triangle = f.first;
    }
    const Vector3d corner = X_FV * vertices[v.first];
    const double gap = normal.dot(corner) - offset;
    if (!(gap > 0 && gap <= threshold) || !is_inside(corner, corners, normal)) return false;
  }
  // none of the other corners is near
  const Vector3d down = X_FV.rotation.conjugate() * normal;
  const double near = offset + threshold - normal.dot(X_FV.position);
  for (const Vector3d& v : vertices)
    if (down.dot(v) <= near &&
        std::ranges::none_of(m.points, [&](const ManifoldPoint& p) { return corner_of(p) == v; }))
      return false;

  m.X_AB = X_AB;
  m.clearance = threshold;
  for (ManifoldPoint& p : m.points) {
    const Vector3d& vertex = corner_of(p);
    const Vector3d corner = X_FV * vertex;
    p.gap = normal.dot(corner) - offset;
    (face_of_a ? p.p_a : p.p_b) = corner - p.gap * normal;
    (face_of_a ? p.p_b : p.p_a) = vertex;
    p.normal = face_of_a ? normal : Vector3d(-(X_AB.rotation * normal));
    m.clearance = std::min(m.clearance, p.gap);
  }
  return true;
}

}  // namespace clench
