#include "clench/dynamics/contact/flat_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "clench/model/near_bodies.h"

namespace clench {

// Faces are flat, and normals one, to so much [m], [rad]; meshes of more triangles take longer than measuring anew.
static constexpr double flat = 1e-12, parallel = 1e-9;
static constexpr size_t max_triangles = 400;

static Pose corners_in_face(const FlatContact& contact, const Pose& X_AB) {
  return contact.face_of_a ? X_AB : X_AB.inverse();
}

static double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

// how far points of a face are from its border; 0: there is none
static double margin(const Mesh& mesh, const Eigen::Vector3d& normal, double offset, const std::vector<Eigen::Vector3d>& points) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& triangle : mesh.triangles) {
    if (std::ranges::any_of(triangle, [&](int v) { return std::abs(normal.dot(mesh.vertices[v]) - offset) > flat; })) continue;
    for (int k = 0; k < 3; ++k) ++edges[std::minmax({triangle[k], triangle[(k + 1) % 3]})];
  }
  double out = std::numeric_limits<double>::infinity();
  for (const auto& [edge, count] : edges)
    if (count == 1)
      for (const Eigen::Vector3d& p : points)
        out = std::min(out, distance_to_segment(p, mesh.vertices[edge.first], mesh.vertices[edge.second]));
  return std::isfinite(out) ? out : 0;
}

static std::optional<FlatContact> find(const World& world, const Manifold& m, bool face_of_a) {
  const Mesh& face = world.body(face_of_a ? m.a : m.b).shape->mesh();
  const Mesh& other = world.body(face_of_a ? m.b : m.a).shape->mesh();
  if (face.triangles.size() + other.triangles.size() > max_triangles) return {};
  FlatContact out{.face_of_a = face_of_a, .threshold = world.contact_threshold()};
  out.X_FV = corners_in_face(out, m.X_AB);
  std::vector<Eigen::Vector3d> corners, feet;
  for (const ManifoldPoint& p : m.points) {
    const Feature &f = face_of_a ? p.feature_a : p.feature_b, &v = face_of_a ? p.feature_b : p.feature_a;
    if (f.kind != Feature::triangle || v.kind != Feature::vertex || p.patch) return {};
    if (corners.empty()) {
      const auto& t = face.triangles[f.first];
      out.normal = (face.vertices[t[1]] - face.vertices[t[0]]).cross(face.vertices[t[2]] - face.vertices[t[0]]).normalized();
      out.offset = out.normal.dot(face.vertices[t[0]]);
    }
    const Eigen::Vector3d normal = face_of_a ? p.normal : Eigen::Vector3d(-(m.X_AB.rotation.conjugate() * p.normal));
    feet.push_back(face_of_a ? p.p_a : p.p_b);
    corners.push_back(face_of_a ? p.p_b : p.p_a);
    if ((normal - out.normal).norm() > parallel || std::abs(out.normal.dot(feet.back()) - out.offset) > flat) return {};
  }
  // all of the one body is behind the face, and of the other only these corners are near it
  for (const Eigen::Vector3d& v : face.vertices)
    if (out.normal.dot(v) > out.offset + flat) return {};
  out.off = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& v : other.vertices)
    if (std::ranges::none_of(corners, [&](const Eigen::Vector3d& c) { return (c - v).squaredNorm() < flat * flat; }))
      out.off = std::min(out.off, out.normal.dot(out.X_FV * v) - out.offset - world.contact_threshold());
  out.along = margin(face, out.normal, out.offset, feet);
  if (!(out.off > 0) || !(out.along > world.contact_threshold())) return {};
  return out;
}

std::optional<FlatContact> find_flat_contact(const World& world, const Manifold& manifold) {
  if (manifold.points.empty() || manifold.clear == 0) return {};
  auto out = find(world, manifold, true);
  return out ? out : find(world, manifold, false);
}

bool follow_flat_contact(const World& world, Manifold& m) {
  if (!m.flat) return false;
  const FlatContact& contact = *m.flat;
  const double threshold = world.contact_threshold();
  if (contact.threshold != threshold || world.body(m.a).elastic_modulus || world.body(m.b).elastic_modulus) return false;
  const Pose X_AB = relative_pose(world, m.a, m.b), X_FV = corners_in_face(contact, X_AB);
  const Shape& shape = *world.body(contact.face_of_a ? m.b : m.a).shape;
  const Eigen::Vector3d moved = X_FV * shape.centre() - contact.X_FV * shape.centre();
  const double turned = 2 * (contact.X_FV.rotation.conjugate() * X_FV.rotation).vec().norm() * shape.radius();
  const double sunk = contact.normal.dot(moved);
  if (std::abs(sunk) + turned >= contact.off || (moved - sunk * contact.normal).norm() + turned >= contact.along) return false;
  for (const ManifoldPoint& p : m.points) {
    const double gap = contact.normal.dot(X_FV * (contact.face_of_a ? p.p_b : p.p_a)) - contact.offset;
    if (!(gap > 0 && gap <= threshold)) return false;
  }
  m.X_AB = X_AB;
  m.clear = threshold;
  for (ManifoldPoint& p : m.points) {
    const Eigen::Vector3d corner = X_FV * (contact.face_of_a ? p.p_b : p.p_a);
    p.gap = contact.normal.dot(corner) - contact.offset;
    (contact.face_of_a ? p.p_a : p.p_b) = corner - p.gap * contact.normal;
    p.normal = contact.face_of_a ? contact.normal : Eigen::Vector3d(-(X_AB.rotation * contact.normal));
    m.clear = std::min(m.clear, p.gap);
  }
  return true;
}

}  // namespace clench
