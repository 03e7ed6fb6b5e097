#include "contact/patch_fit.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "math/decompositions.h"

namespace clench {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using SurfacePoints = std::span<const Vector3d>;

namespace {

constexpr int most_fit_rounds = 40;
constexpr double settled = 1e-12;  // change of curvatures times the scale
// Of the mean of squared columns, which are about 0.1: what no point tells stays flat, what the
// points tell changes by 1e-10 of itself.
constexpr double ridge = 1e-12;
// z - m/2 z^2 must rise with z
constexpr double most_bend = 0.9;

// of z - m/2 z^2 = c0 + c1 x + c2 y + (k11 x^2 + 2 k12 xy + k22 y^2) / 2
using Coefficients = Eigen::Matrix<double, 6, 1>;

struct Principal {
  Vector2d values;          // descending
  Eigen::Matrix2d vectors;  // columns
};

Principal principal(double k11, double k12, double k22) {
  const double mean = 0.5 * (k11 + k22), half = 0.5 * (k11 - k22);
  const double radius = std::hypot(half, k12), angle = 0.5 * std::atan2(k12, half);
  Principal out;
  out.values << mean + radius, mean - radius;
  out.vectors << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return out;
}

// What circles add to parabolas at p: m/2 z^2, where m is the mean of the principal curvatures,
// weighted by what each adds to the height.
double rounding_up(const Principal& k, const Vector3d& p, double most) {
  const Vector2d part =
      k.values.cwiseAbs().cwiseProduct((k.vectors.transpose() * p.head<2>()).cwiseAbs2());
  if (part.sum() == 0) return 0;
  const double m = std::clamp(part.dot(k.values) / part.sum(), -most, most);
  return 0.5 * m * p.z() * p.z();
}

Coefficients solve_quadric(const std::vector<Vector3d>& points, std::span<const double> weights,
                           const Principal& before) {
  double highest = 0;
  for (const Vector3d& p : points) highest = std::max(highest, std::abs(p.z()));
  const double most = most_bend / std::max(highest, 1e-9);
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Coefficients right = Coefficients::Zero();
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector3d& p = points[i];
    const double w = weights.empty() ? 1 : weights[i];
    Coefficients row;
    row << 1, p.x(), p.y(), 0.5 * p.x() * p.x(), p.x() * p.y(), 0.5 * p.y() * p.y();
    normal += w * row * row.transpose();
    right += w * (p.z() - rounding_up(before, p, most)) * row;
  }
  normal.diagonal().array() += ridge * static_cast<double>(points.size());
  return solve_symmetric(normal, right);
}

}  // namespace

void measure_fit(SurfacePoints points, const Vector3d& origin, SurfaceFit& fit,
                 std::span<const double> weights) {
  Matrix3d axes;
  axes << fit.directions, fit.normal;
  const auto weight = [&](size_t i) { return weights.empty() ? 1 : weights[i]; };
  double count = 0;
  for (size_t i = 0; i < points.size(); ++i) count += weight(i);
  const Principal k = {fit.curvatures, Eigen::Matrix2d::Identity()};
  std::vector<Vector3d> local;
  double mean = 0, highest = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    local.push_back(axes.transpose() * (points[i] - origin));
    mean += weight(i) * local.back().z() / count;
    highest = std::max(highest, std::abs(local.back().z()));
  }
  double off = 0, relief = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector3d& q = local[i];
    const double most = highest > 0 ? most_bend / highest : 0;
    const double height =
        0.5 * fit.curvatures.dot(q.head<2>().cwiseAbs2()) + rounding_up(k, q, most);
    off += weight(i) * (q.z() - height) * (q.z() - height);
    relief += weight(i) * (q.z() - mean) * (q.z() - mean);
  }
  fit.residual = std::sqrt(off / count);
  fit.relief = std::sqrt(relief / count);
}

SurfaceFit fit_quadric(SurfacePoints points, double scale, std::span<const double> weights) {
  if (points.size() < 3)
    fail("contact patch: a surface needs 3 points at least, got {}", points.size());
  Matrix3d axes = Matrix3d::Identity();  // columns: the tangent frame
  Vector3d origin = Vector3d::Zero();
  Principal now = principal(0, 0, 0);
  std::vector<Vector3d> local(points.size());
  for (int round = 0; round < most_fit_rounds; ++round) {
    for (size_t i = 0; i < points.size(); ++i)
      local[i] = axes.transpose() * (points[i] - origin) / scale;
    const Coefficients c = solve_quadric(local, weights, now);
    const Vector2d before = now.values;
    now = principal(c[3], c[4], c[5]);
    const double moved = c.head<3>().cwiseAbs().sum() + (now.values - before).norm();
    if (moved < settled) break;
    // the next tangent frame: at the foot of the fit, along its normal
    origin += axes.col(2) * c[0] * scale;
    const Vector3d normal = axes * Vector3d(-c[1], -c[2], 1).normalized();
    axes = least_turn(axes.col(2), normal).toRotationMatrix() * axes;
  }
  SurfaceFit fit;
  fit.curvatures = now.values / scale;
  fit.directions = axes.leftCols<2>() * now.vectors;
  fit.normal = axes.col(2);
  measure_fit(points, origin, fit, weights);
  return fit;
}

}  // namespace clench
