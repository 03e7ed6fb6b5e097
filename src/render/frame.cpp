#include "clench/render/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "clench/base/convert.h"
#include "clench/base/error.h"

namespace clench {
namespace {

constexpr double used = 0.84;  // part of the frame's width and height that a framed scene may fill

constexpr int around = 12;  // directions tried at either height

// from the front right, a little above
const Eigen::Vector3d default_back(0.62, -0.70, 0.42), steeper_back(0.62, -0.70, 0.75);

}  // namespace

Eigen::Matrix3d view_axes(const Eye& eye) {
  if (!eye.eye.allFinite() || !eye.target.allFinite() || !eye.up.allFinite())
    fail("picture: eye, target and up must be finite numbers");
  if (!(eye.field_of_view >= 0.001 && eye.field_of_view <= 3))
    fail("picture: field of view must be between 0.001 and 3 [rad], got {}", eye.field_of_view);
  const Eigen::Vector3d away = eye.eye - eye.target;
  const double distance = away.stableNorm();
  if (!(distance > 0) || !std::isfinite(distance))
    fail("picture: eye and target must be two points, got ({}, {}, {}) for the eye", eye.eye.x(),
         eye.eye.y(), eye.eye.z());
  Eigen::Matrix3d axes;
  const Eigen::Vector3d back = away / distance;
  Eigen::Vector3d up = eye.up.stableNormalized();
  // an up that the view hides: take the axis most across the view instead, y first
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
  const double focal = 1 / std::tan(eye.field_of_view / 2);
  projection(0, 0) = focal / aspect;
  projection(1, 1) = focal;
  projection(2, 2) = -(far + near) / (far - near);
  projection(2, 3) = -2 * far * near / (far - near);
  projection(3, 2) = -1;
  return projection * view;
}

namespace {

// the view of this direction that holds everything; `corners` are not empty
Eye fit(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& direction,
        double aspect) {
  Eye eye;
  eye.eye = direction;
  const Eigen::Matrix3d axes = view_axes(eye);
  // slopes of the frame's sides; each side is a plane through the eye that every corner lies
  // behind: |x - ex| <= slope (ez - z)
  const double y_slope = used * std::tan(eye.field_of_view / 2);
  const Eigen::Array2d slope(y_slope * aspect, y_slope);
  Eigen::Array2d high(-1e9, -1e9), low(-1e9, -1e9);
  double nearest = -1e9, farthest = 1e9;
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d p = axes.transpose() * corner;
    high = high.max(slope * p.z() + p.head<2>().array());
    low = low.max(slope * p.z() - p.head<2>().array());
    nearest = std::max(nearest, p.z());
    farthest = std::min(farthest, p.z());
  }

  // as near as the narrower pair of sides allows, but not inside a flat scene that is seen along
  // itself
  const double back = std::max(((high + low) / (2 * slope)).maxCoeff(), nearest + 0.05);
  const Eigen::Vector2d across = (high - low) / 2;
  eye.eye = axes * Eigen::Vector3d(across.x(), across.y(), back);
  eye.target = axes * Eigen::Vector3d(across.x(), across.y(), (nearest + farthest) / 2);
  return eye;
}

// what of a list one view shows, on a raster coarse enough that corners alone fill it
class Overview {
 public:
  Overview(const Eye& eye, double aspect)
      : axes_(view_axes(eye)),
        eye_(eye.eye),
        focal_(1 / std::tan(eye.field_of_view / 2)),
        aspect_(aspect) {
    nearest_.fill(1e9);
    covered_.fill(false);
  }
  void hide(const Eigen::Vector3d& p) {
    const auto [cell, depth] = place(p);
    nearest_[cell] = std::min(nearest_[cell], depth);
  }
  void cover(const Eigen::Vector3d& p) { covered_[place(p).first] = true; }
  bool shows(const Eigen::Vector3d& p) const {
    const auto [cell, depth] = place(p);
    return depth < nearest_[cell] + 0.04;
  }
  double covered() const {
    return static_cast<double>(std::count(covered_.begin(), covered_.end(), true)) /
           (columns * rows);
  }

 private:
  static constexpr int columns = 32, rows = 24;
  std::pair<int, double> place(const Eigen::Vector3d& p_scene) const {
    const Eigen::Vector3d p = axes_.transpose() * (p_scene - eye_);
    const double depth = std::max(1e-6, -p.z());
    const auto cell = [&](double x, int count) {
      return floor_between((0.5 + 0.5 * x) * count, 0, count - 1);
    };
    const int column = cell(std::clamp(focal_ / aspect_ * p.x() / depth, -1.0, 1.0), columns);
    return {column + columns * cell(std::clamp(focal_ * p.y() / depth, -1.0, 1.0), rows), depth};
  }
  Eigen::Matrix3d axes_;
  Eigen::Vector3d eye_;
  double focal_, aspect_;
  std::array<double, columns * rows> nearest_;
  std::array<bool, columns * rows> covered_;
};

// part of a batch's corners that nothing solid hides
double part_shown(const DrawList& list, const Batch& batch, const Overview& view) {
  int shown = 0;
  for (int i = batch.first; i < batch.first + batch.count; ++i)
    shown += view.shows(list.corners[list.indices[i]].p.cast<double>());
  return batch.count ? static_cast<double>(shown) / batch.count : 0;
}

// how much of contacts, of what is grasped, and of the frame a view shows
double worth(const DrawList& list, const std::vector<Eigen::Vector3d>& corners, const Eye& eye,
             double aspect) {
  Overview view(eye, aspect);
  for (const Batch& batch : list.solid)
    for (int i = batch.first; i < batch.first + batch.count; ++i)
      view.hide(corners[list.indices[i]]);
  for (const Eigen::Vector3d& corner : corners) view.cover(corner);
  double clear = 0;
  for (const Batch& batch : list.clear) clear += part_shown(list, batch, view) / list.clear.size();
  return part_shown(list, list.marks, view) + 0.7 * clear + view.covered();
}

}  // namespace

Eye frame(const DrawList& list, double aspect) {
  std::vector<Eigen::Vector3d> corners;
  for (size_t i = 0; i < list.body_corners; ++i)
    corners.push_back(list.corners[i].p.cast<double>());
  if (corners.empty())
    return fit({{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {-0.5, 0.5, 0}, {0.5, 0.5, 0}}, default_back,
               aspect);

  // from all around; the default unless another shows clearly more
  Eye best;
  double most = -1;
  for (int k = 0; k < 2 * around; ++k) {
    const Pose turn =
        Pose::turn(2 * std::numbers::pi * (k % around) / around, Eigen::Vector3d::UnitZ());
    const Eye eye = fit(corners, turn * (k < around ? default_back : steeper_back), aspect);
    const double value = worth(list, corners, eye, aspect) + (k == 0 ? 0.15 : 0);
    if (value > most) best = eye, most = value;
  }
  return best;
}

}  // namespace clench
