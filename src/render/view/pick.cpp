#include "clench/render/view/pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/view/frame.h"

namespace clench {
namespace {

struct Ray {
  Eigen::Vector3d from, along;  // world; along is unit
};

// keeps the nearest hit of a ray
class Nearest {
 public:
  explicit Nearest(const Ray& ray) : ray_(ray) {}

  double limit() const {
    return found_ ? found_->distance : std::numeric_limits<double>::infinity();
  }
  void add(double distance, const Eigen::Vector3d& normal, const Shown& shown) {
    if (!(distance > 0 && distance < limit())) return;
    const Eigen::Vector3d n = normal.normalized();
    found_ = Picked{.shown = shown,
                    .p_W = ray_.from + distance * ray_.along,
                    .n_W = n.dot(ray_.along) > 0 ? Eigen::Vector3d(-n) : n,
                    .distance = distance};
  }
  const std::optional<Picked>& found() const { return found_; }

 private:
  const Ray& ray_;
  std::optional<Picked> found_;
};

Eigen::Vector3d across(const std::array<Eigen::Vector3d, 3>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

void meet_mesh(const DrawMesh& mesh, const Ray& ray, Nearest& nearest) {
  if (!mesh.shape || mesh.opacity == 0 || mesh.shape->mesh().triangles.empty()) return;
  const Pose X_MW = mesh.X_WM.inverse();
  const auto hit =
      cast_ray(*mesh.shape, X_MW * ray.from, X_MW.rotation * ray.along, nearest.limit());
  if (!hit) return;
  const Eigen::Vector3d normal = across(mesh.shape->mesh().corners(hit->triangle));
  nearest.add(hit->distance, mesh.X_WM.rotation * normal, mesh.shown);
}

// source  Moeller & Trumbore (1997)
std::optional<double> meet_triangle(const std::array<Eigen::Vector3d, 3>& corners, const Ray& ray) {
  const Eigen::Vector3d a = corners[1] - corners[0], b = corners[2] - corners[0],
                        p = ray.along.cross(b), off = ray.from - corners[0], q = off.cross(a);
  const double det = a.dot(p);
  if (det == 0) return std::nullopt;
  const double u = off.dot(p) / det, v = ray.along.dot(q) / det;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) return std::nullopt;
  return b.dot(q) / det;
}

void meet_mark(const Piece& piece, const Shown& shown, const Ray& ray, Nearest& nearest) {
  for (const Triangle& t : piece.triangles) {
    const std::array corners{piece.p_W[t[0]], piece.p_W[t[1]], piece.p_W[t[2]]};
    if (const auto distance = meet_triangle(corners, ray))
      nearest.add(*distance, across(corners), shown);
  }
}

void meet_floor(double height, const Ray& ray, Nearest& nearest) {
  if (ray.along.z() < 0 && ray.from.z() > height)
    nearest.add((height - ray.from.z()) / ray.along.z(), Eigen::Vector3d::UnitZ(),
                {.kind = Shown::Kind::floor});
}

// upper bound on the distance of all meshes and marks from the plane of the eye
double depth_of(const Scene& scene, const Eigen::Vector3d& eye) {
  double most = 0;
  const auto add = [&](const Eigen::Vector3d& p, double radius) {
    most = std::max(most, (p - eye).norm() + radius);
  };
  for (const DrawMesh& mesh : scene.meshes)
    if (mesh.shape) add(mesh.X_WM * mesh.shape->center(), mesh.shape->radius());
  for (const DrawCone& cone : scene.cones)
    for (const auto& p : cone_piece(cone).p_W) add(p, 0);
  for (const DrawArrow& arrow : scene.arrows)
    for (const auto& p : arrow_piece(arrow).p_W) add(p, 0);
  return most;
}

}  // namespace

std::optional<Picked> pick(const Scene& scene, const Eye& eye, const PicturePlace& place) {
  check(scene);
  if (!(place.width > 0 && place.height > 0 && std::isfinite(place.width + place.height)))
    fail("picture: its size must be > 0, got {} x {}", place.width, place.height);
  const Eigen::Matrix3d axes = view_axes(eye);
  const double x = (2 * place.x - place.width) / place.height - 2 * eye.aside,
               y = 1 - 2 * place.y / place.height;
  const bool flat = eye.ortho_height > 0;
  const double half = flat ? eye.ortho_height / 2 : std::tan(eye.field_of_view / 2);
  const Eigen::Vector3d aside = half * (x * axes.col(0) + y * axes.col(1));
  Ray ray{eye.eye, (aside - axes.col(2)).normalized()};
  // an orthographic view also shows what is behind the eye
  const double behind = flat ? 1.1 * depth_of(scene, eye.eye) : 0;
  if (flat) ray = {eye.eye + aside + behind * axes.col(2), -axes.col(2)};

  Nearest nearest(ray);
  for (const DrawMesh& mesh : scene.meshes) meet_mesh(mesh, ray, nearest);
  for (const DrawCone& cone : scene.cones) meet_mark(cone_piece(cone), cone.shown, ray, nearest);
  for (const DrawArrow& arrow : scene.arrows)
    meet_mark(arrow_piece(arrow), arrow.shown, ray, nearest);
  if (scene.ground) meet_floor(*scene.ground, ray, nearest);
  std::optional<Picked> found = nearest.found();
  if (found) found->distance -= behind;
  return found;
}

}  // namespace clench
