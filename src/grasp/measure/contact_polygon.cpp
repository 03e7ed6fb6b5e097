#include "clench/grasp/measure/contact_polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/contact/outline.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::Vector2d, Eigen::Vector3d;

namespace {

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// source  Roa & Suarez (2015), eq. 12: the sum of all deviations divided by that of a flat polygon
double irregularity_of(const std::vector<Vector2d>& corners) {
  const auto count = static_cast<double>(corners.size());
  constexpr double half_turn = std::numbers::pi;
  const double regular = half_turn * (count - 2) / count;
  // flat: all angles are half turns except two, which are zero
  const double most = (count - 2) * (half_turn - regular) + 2 * regular;
  double sum = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vector2d before = corners[(i + corners.size() - 1) % corners.size()] - corners[i];
    const Vector2d after = corners[(i + 1) % corners.size()] - corners[i];
    const double cross = after.x() * before.y() - after.y() * before.x();
    sum += std::abs(std::atan2(cross, after.dot(before)) - regular);
  }
  return std::min(1.0, sum / most);
}

}  // namespace

// one of several points nearer than a micrometer
static std::vector<Vector3d> distinct(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> out;
  for (const Vector3d& p : points)
    if (std::ranges::none_of(out, [&](const Vector3d& q) { return (p - q).norm() < 1e-6; }))
      out.push_back(p);
  return out;
}

ContactPolygon contact_polygon(const std::vector<Vector3d>& all) {
  const std::vector<Vector3d> points = distinct(all);
  ContactPolygon polygon;
  for (const Vector3d& p : points) polygon.centroid += p / static_cast<double>(points.size());

  // the least-squares plane: normal to the direction in which the points vary least
  Eigen::MatrixXd offsets(3, static_cast<Eigen::Index>(points.size()));
  for (size_t i = 0; i < points.size(); ++i)
    offsets.col(static_cast<Eigen::Index>(i)) = points[i] - polygon.centroid;
  const Eigen::Matrix3d scatter = offsets * offsets.transpose();
  const auto axes = eigensystem(scatter).vectors;
  const Vector3d x = axes.col(2), y = axes.col(1);
  polygon.normal = x.cross(y);

  std::vector<Vector2d> flat, corners;
  double size = 0;
  for (Eigen::Index i = 0; i < offsets.cols(); ++i) {
    flat.emplace_back(x.dot(offsets.col(i)), y.dot(offsets.col(i)));
    size = std::max(size, flat.back().norm());
  }
  // a corner that protrudes by no more than rounding is omitted
  for (const int i : outline(flat, 1e-12 * size)) corners.push_back(flat[static_cast<size_t>(i)]);
  for (const Vector2d& c : corners)
    polygon.corners.push_back(polygon.centroid + c.x() * x + c.y() * y);
  if (corners.size() < 3) return polygon;

  for (size_t i = 1; i + 1 < corners.size(); ++i)
    polygon.area += turn(corners[0], corners[i], corners[i + 1]) / 2;
  polygon.irregularity = irregularity_of(corners);
  return polygon;
}

}  // namespace clench
