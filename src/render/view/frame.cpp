#include "clench/render/view/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "clench/base/convert.h"
#include "clench/base/error.h"
#include "clench/render/mesh/extent.h"
#include "clench/render/mesh/pieces.h"

namespace clench {
namespace {

// fraction of the frame's width and height that a framed scene may fill
constexpr double used = 0.84;

// numbers of points that views are compared by: on surfaces, on what must be in the frame, and on
// contacts
constexpr int looked_at = 5000, framed_looked_at = 1500, marks_looked_at = 1000;
constexpr int around = 12;  // directions tried at each of the two heights

// from the front right, slightly from above
const Eigen::Vector3d default_back(0.62, -0.70, 0.42), steeper_back(0.62, -0.70, 0.75);

}  // namespace

Eigen::Matrix3d view_axes(const Eye& eye) {
  if (!eye.eye.allFinite() || !eye.target.allFinite() || !eye.up.allFinite())
    fail("picture: eye, target and up must be finite numbers");
  if (!(eye.field_of_view >= 0.001 && eye.field_of_view <= 3))
    fail("picture: field of view must be between 0.001 and 3 [rad], got {}", eye.field_of_view);
  if (!(eye.ortho_height >= 0 && std::isfinite(eye.ortho_height)))
    fail("picture: the height of an orthographic view must be >= 0 [m], got {}", eye.ortho_height);
  if (!std::isfinite(eye.aside))
    fail("picture: the shift of a view must be finite, got {}", eye.aside);
  const Eigen::Vector3d away = eye.eye - eye.target;
  const double distance = away.stableNorm();
  if (!(distance > 0) || !std::isfinite(distance))
    fail("picture: eye and target must be two points, got ({}, {}, {}) for the eye", eye.eye.x(),
         eye.eye.y(), eye.eye.z());
  Eigen::Matrix3d axes;
  const Eigen::Vector3d back = away / distance;
  Eigen::Vector3d up = eye.up.stableNormalized();
  // `up` is along the view: use the axis most across the view instead, y first
  if (up.cross(back).norm() < 1e-6) {
    int across = 1;
    for (const int k : {2, 0})
      if (std::abs(back[k]) < std::abs(back[across]) - 1e-6) across = k;
    up = Eigen::Vector3d::Unit(across);
  }
  axes.col(2) = back;
  axes.col(0) = up.cross(back).normalized();
  axes.col(1) = back.cross(axes.col(0));
  return axes;
}

Eigen::Matrix4d view_projection(const Eye& eye, double aspect, double near, double far) {
  const Eigen::Matrix3d axes = view_axes(eye);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = axes.transpose();
  view.topRightCorner<3, 1>() = -axes.transpose() * eye.eye;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  if (eye.ortho_height > 0) {
    const double half = eye.ortho_height / 2;
    projection(0, 0) = 1 / (half * aspect);
    projection(0, 3) = 2 * eye.aside / aspect;
    projection(1, 1) = 1 / half;
    projection(2, 2) = -2 / (far - near);
    projection(2, 3) = -(far + near) / (far - near);
    projection(3, 3) = 1;
    return projection * view;
  }
  const double focal = 1 / std::tan(eye.field_of_view / 2);
  projection(0, 0) = focal / aspect;
  projection(0, 2) = -2 * eye.aside / aspect;
  projection(1, 1) = focal;
  projection(2, 2) = -(far + near) / (far - near);
  projection(2, 3) = -2 * far * near / (far - near);
  projection(3, 2) = -1;
  return projection * view;
}

namespace {

using Points = std::vector<Eigen::Vector3d>;

// sample points of a scene, relative to the center of what must be in the frame and divided by its
// radius
struct Sight {
  Points framed;  // all vertices that must be in the frame
  Points solid, aside, clear,
      marks;    // samples of occluders; of what need not be seen; of what should be seen
  Points held;  // further points that must be in the frame
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;
};

// points evenly spread over a mesh, `per_area` of them per unit of its area
// source  Roberts (2018), The unreasonable effectiveness of quasirandom sequences
void spread_over(const Points& p, const std::vector<Triangle>& triangles,
                 const std::vector<double>& areas, double per_area, Points& out) {
  double due = 0.5, a = 0.5, b = 0.5;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    for (due += areas[i] * per_area; due >= 1; --due) {
      a += 0.7548776662466927, b += 0.5698402909980532;
      a -= std::floor(a), b -= std::floor(b);
      const bool over = a + b > 1;
      out.push_back(p[t[0]] + (over ? 1 - a : a) * (p[t[1]] - p[t[0]]) +
                    (over ? 1 - b : b) * (p[t[2]] - p[t[0]]));
    }
  }
}

std::vector<double> areas_of(const Points& p, const std::vector<Triangle>& triangles) {
  std::vector<double> out;
  out.reserve(triangles.size());
  for (const Triangle& t : triangles)
    out.push_back(0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm());
  return out;
}

void append(Points& to, const Points& from) { to.insert(to.end(), from.begin(), from.end()); }

// about `count` of the points, evenly from first to last
Points every_so_often(const Points& points, size_t count) {
  const size_t step = 1 + points.size() / count;
  Points out;
  for (size_t i = 0; i < points.size(); i += step) out.push_back(points[i]);
  return out;
}

// moves points relative to the center of all that must be in the frame, and divides by its radius
void normalize(std::vector<Points>& placed, const std::vector<bool>& must, Sight& sight) {
  const auto ball = ball_around([&](const auto& what) {
    for (size_t i = 0; i < placed.size(); ++i)
      if (must[i])
        for (const auto& p : placed[i]) what(p);
    for (const auto& p : sight.held) what(p);
  });
  if (!ball) return;
  sight.center = ball->center, sight.scale = ball->scale;
  const double unit = 1 / sight.scale;
  for (Points& points : placed)
    for (auto& p : points) p = unit * (p - sight.center);
  for (Points* points : {&sight.marks, &sight.held})
    for (auto& p : *points) p = unit * (p - sight.center);
}

// adds cones and arrows, other points that must be in the frame, and points that should be seen
void add_marks(const Scene& scene, Sight& sight) {
  for (const DrawCone& cone : scene.cones) append(sight.held, cone_piece(cone).p_W);
  for (const DrawArrow& arrow : scene.arrows) append(sight.held, arrow_piece(arrow).p_W);
  sight.marks = scene.spots.empty() ? sight.held : scene.spots;
  append(sight.held, scene.held);
}

Sight sight_of(const Scene& scene) {
  Sight sight;
  std::vector<const DrawMesh*> meshes;
  bool any = false;
  for (const DrawMesh& mesh : scene.meshes)
    if (mesh.shape && mesh.opacity > 0 && !mesh.shape->mesh().vertices.empty()) {
      meshes.push_back(&mesh);
      any = any || (!mesh.background && mesh.framed);
    }
  add_marks(scene, sight);
  // with only a floor, the floor is what must be seen
  const bool only_floor = sight.held.empty() &&
                          std::ranges::all_of(meshes, [](const auto* m) { return m->background; });
  std::vector<Points> placed;
  std::vector<bool> must;
  for (const DrawMesh* mesh : meshes) {
    Points points = mesh->shape->mesh().vertices;
    const Eigen::Matrix3d R = mesh->X_WM.rotation.toRotationMatrix();
    for (auto& p : points) p = R * p + mesh->X_WM.position;
    placed.push_back(std::move(points));
    must.push_back(only_floor || (!mesh->background && (mesh->framed || !any)));
  }
  normalize(placed, must, sight);

  std::vector<std::vector<double>> areas;
  std::array<double, 2> all = {};
  for (size_t i = 0; i < meshes.size(); ++i) {
    areas.push_back(areas_of(placed[i], meshes[i]->shape->mesh().triangles));
    all[must[i]] += std::accumulate(areas[i].begin(), areas[i].end(), 0.0);
  }
  for (size_t i = 0; i < meshes.size(); ++i) {
    if (must[i]) append(sight.framed, placed[i]);
    if (meshes[i]->background) continue;
    const bool clear = meshes[i]->opacity < 0.999f && !meshes[i]->hides;
    Points& to = clear ? sight.clear : must[i] ? sight.solid : sight.aside;
    if (all[must[i]] > 0)
      spread_over(placed[i], meshes[i]->shape->mesh().triangles, areas[i],
                  (must[i] ? 1.0 : 0.3) * looked_at / all[must[i]], to);
  }
  append(sight.framed, sight.held);
  sight.marks = every_so_often(sight.marks, marks_looked_at);
  return sight;
}

// the view in this direction that holds all `corners`, which are not empty
Eye fit(const Points& corners, const Eigen::Vector3d& direction, double aspect, bool ortho) {
  Eye eye;
  eye.eye = direction;
  const Eigen::Matrix3d axes = view_axes(eye);
  // slopes of the frame's sides; each side is a plane through the eye that every corner lies
  // behind: |x - ex| <= slope (ez - z)
  const double y_slope = used * std::tan(eye.field_of_view / 2);
  const Eigen::Array2d slope(y_slope * aspect, y_slope);
  const Eigen::Array2d lean = ortho ? Eigen::Array2d::Zero() : slope;
  Eigen::Array2d high(-1e9, -1e9), low(-1e9, -1e9);
  double nearest = -1e9, farthest = 1e9;
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d p = axes.transpose() * corner;
    high = high.max(lean * p.z() + p.head<2>().array());
    low = low.max(lean * p.z() - p.head<2>().array());
    nearest = std::max(nearest, p.z());
    farthest = std::min(farthest, p.z());
  }

  // as near as the narrower pair of sides allows, but not inside a flat scene that is seen edge-on
  const Eigen::Array2d half = (high + low) / 2;
  const double back = std::max((half / slope).maxCoeff(), nearest + 0.05);
  const Eigen::Vector2d across = (high - low) / 2;
  if (ortho) eye.ortho_height = std::max(2 / used * std::max(half.y(), half.x() / aspect), 1e-6);
  eye.eye = axes * Eigen::Vector3d(across.x(), across.y(), back);
  eye.target = axes * Eigen::Vector3d(across.x(), across.y(), (nearest + farthest) / 2);
  return eye;
}

// content of a view, on a raster coarse enough that sample points fill it
class Overview {
 public:
  Overview(const Eye& eye, double aspect)
      : axes_(view_axes(eye).transpose()),
        eye_(eye.eye),
        focal_(eye.ortho_height > 0 ? 2 / eye.ortho_height : 1 / std::tan(eye.field_of_view / 2)),
        aspect_(aspect),
        ortho_(eye.ortho_height > 0) {
    nearest_.fill(1e9);
  }
  void hide(const Points& points, bool aside) {
    for (const auto& p : points) {
      const auto [cell, depth] = place(p);
      if (cell < 0) continue;
      covered_[cell] = covered_[cell] || !aside;
      if (depth >= nearest_[cell]) continue;
      nearest_[cell] = depth;
      aside_[cell] = aside;
    }
  }
  // fraction of points that no opaque surface hides; they also cover the picture
  double shown(const Points& points) {
    int count = 0;
    for (const auto& p : points) {
      const auto [cell, depth] = place(p);
      if (cell < 0) continue;
      covered_[cell] = true;
      count += depth < nearest_[cell] + 0.04;
    }
    return points.empty() ? 0 : static_cast<double>(count) / static_cast<double>(points.size());
  }
  double covered() const { return part(covered_); }
  double aside() const { return part(aside_); }

 private:
  static constexpr int columns = 32, rows = 24;
  using Raster = std::array<bool, columns * rows>;
  static double part(const Raster& raster) {
    return static_cast<double>(std::ranges::count(raster, true)) / (columns * rows);
  }
  // raster cell, -1 outside the view, and distance
  std::pair<int, double> place(const Eigen::Vector3d& at) const {
    const Eigen::Vector3d p = axes_ * (at - eye_);
    const double depth = -p.z(), by = ortho_ ? focal_ : focal_ / depth;
    if (!(depth > 1e-6)) return {-1, depth};
    const double x = 0.5 + 0.5 * by / aspect_ * p.x(), y = 0.5 + 0.5 * by * p.y();
    if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) return {-1, depth};
    return {static_cast<int>(x * columns) + columns * static_cast<int>(y * rows), depth};
  }
  Eigen::Matrix3d axes_;
  Eigen::Vector3d eye_;
  double focal_, aspect_;
  bool ortho_;
  std::array<double, columns * rows> nearest_;
  Raster covered_ = {}, aside_ = {};
};

// position of a view relative to what need not be seen: from 1 behind it, looking over it, to -1
double beside(const Sight& sight, const Eigen::Vector3d& direction) {
  const Points& wanted = sight.marks.empty() ? sight.framed : sight.marks;
  if (sight.aside.empty() || wanted.empty()) return 0;
  const auto middle = [](const Points& points) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& p : points) sum += p;
    return Eigen::Vector3d(sum / static_cast<double>(points.size()));
  };
  const Eigen::Vector3d off = middle(sight.aside) - middle(wanted);
  return off.norm() > 1e-9 ? off.normalized().dot(direction.normalized()) : 0;
}

// score of a view: visible contacts, grasped object and frame, minus what need not be seen
double worth(const Sight& sight, const Eye& eye, double aspect) {
  Overview view(eye, aspect);
  view.hide(sight.solid, false);
  view.hide(sight.aside, true);
  const double marks = view.shown(sight.marks), clear = view.shown(sight.clear);
  return 1.5 * marks + 0.7 * clear + view.covered() - 3 * view.aside();
}

}  // namespace

Eye frame(const Scene& scene, double aspect, bool ortho) {
  if (!(aspect > 0 && std::isfinite(aspect))) fail("picture: aspect must be > 0, got {}", aspect);
  const Sight sight = sight_of(scene);
  if (sight.framed.empty())
    return fit({{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {-0.5, 0.5, 0}, {0.5, 0.5, 0}}, default_back,
               aspect, ortho);

  // directions all around; the default is kept unless another shows clearly more
  const Points some = every_so_often(sight.framed, framed_looked_at);
  Eigen::Vector3d best = default_back;
  double most = -1e9;
  for (int k = 0; k < 2 * around; ++k) {
    const Pose turn =
        Pose::turn(2 * std::numbers::pi * (k % around) / around, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d direction = turn * (k < around ? default_back : steeper_back);
    const double value = worth(sight, fit(some, direction, aspect, ortho), aspect) +
                         (k == 0 ? 0.15 : 0) - 0.5 * beside(sight, direction);
    if (value > most) best = direction, most = value;
  }
  Eye eye = fit(sight.framed, best, aspect, ortho);
  eye.eye = sight.center + sight.scale * eye.eye;
  eye.target = sight.center + sight.scale * eye.target;
  eye.ortho_height *= sight.scale;
  return eye;
}

}  // namespace clench
