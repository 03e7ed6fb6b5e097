#include "clench/grasp/measure/contact_polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/math/decompositions.h"

namespace clench {

using Eigen::Vector2d, Eigen::Vector3d;

namespace {

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Convex hull, counter-clockwise. A corner that turns by less than rounding is none.
// source  Andrew (1979), monotone chain
std::vector<Vector2d> hull_of(std::vector<Vector2d> points) {
  double size = 0;
  for (const Vector2d& p : points) size = std::max(size, p.norm());
  // products of lengths below `size` are good to a few times 1e-16; contacts differ by far more
  const double flat = 1e-12 * size * size;
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  std::vector<Vector2d> hull;
  for (const bool back : {false, true}) {
    const size_t base = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= flat)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // where the other side begins
    if (!back) std::reverse(points.begin(), points.end());
  }
  return hull;
}

// source  Roa & Suarez (2015), eq. 12: the sum of all deviations over that of a flat polygon
double irregularity_of(const std::vector<Vector2d>& corners) {
  const auto count = static_cast<double>(corners.size());
  constexpr double half_turn = std::numbers::pi;
  const double regular = half_turn * (count - 2) / count;
  // flat: all angles half turns but two, which are none
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

// of points nearer than a micrometre, one
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

  // the plane of least squares: across the direction in which the points vary least
  Eigen::MatrixXd offsets(3, static_cast<Eigen::Index>(points.size()));
  for (size_t i = 0; i < points.size(); ++i)
    offsets.col(static_cast<Eigen::Index>(i)) = points[i] - polygon.centroid;
  const Eigen::Matrix3d scatter = offsets * offsets.transpose();
  const auto axes = eigensystem(scatter).vectors;
  const Vector3d x = axes.col(2), y = axes.col(1);
  polygon.normal = x.cross(y);

  std::vector<Vector2d> flat;
  for (Eigen::Index i = 0; i < offsets.cols(); ++i)
    flat.emplace_back(x.dot(offsets.col(i)), y.dot(offsets.col(i)));
  const std::vector<Vector2d> corners = hull_of(std::move(flat));
  for (const Vector2d& c : corners)
    polygon.corners.push_back(polygon.centroid + c.x() * x + c.y() * y);
  if (corners.size() < 3) return polygon;

  for (size_t i = 1; i + 1 < corners.size(); ++i)
    polygon.area += turn(corners[0], corners[i], corners[i + 1]) / 2;
  polygon.irregularity = irregularity_of(corners);
  return polygon;
}

}  // namespace clench
