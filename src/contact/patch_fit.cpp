#include "clench/contact/patch_fit.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using PointSpan = std::span<const Vector3d>;

namespace {

constexpr int max_fit_rounds = 40;
constexpr double settled = 1e-12;  // change of curvatures times the scale
// Relative to the mean of squared columns, which are about 0.1: directions without data stay flat,
// determined ones change by a relative 1e-10.
constexpr double ridge = 1e-12;
// z - m/2 z^2 must increase with z
constexpr double max_bend = 0.9;
constexpr double tiny = 1e-300;

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

using Column = Eigen::ArrayXd;

// points by coordinate, which makes sums faster
struct Columns {
  explicit Columns(size_t count) : x(count), y(count), z(count) {}
  Column x, y, z;
};

// weights, 1 if none are given
Column weight_column(std::span<const double> weights, size_t count) {
  if (weights.empty()) return Column::Ones(static_cast<Eigen::Index>(count));
  return Eigen::Map<const Column>(weights.data(), static_cast<Eigen::Index>(count));
}

void move_into(const Matrix3d& axes, const Vector3d& origin, double scale, PointSpan points,
               Columns& out) {
  const Eigen::Map<const Eigen::Matrix3Xd> all(points[0].data(), 3,
                                               static_cast<Eigen::Index>(points.size()));
  const auto along = [&](int k) {
    const Vector3d axis = axes.col(k) / scale;
    return (axis[0] * all.row(0).array() + axis[1] * all.row(1).array() +
            axis[2] * all.row(2).array() - axis.dot(origin))
        .transpose();
  };
  out.x = along(0), out.y = along(1), out.z = along(2);
}

// Correction for circular profiles: m/2 z^2, where m is the mean of the principal curvatures,
// weighted by their contributions to the height.
Column rounding_up(const Principal& k, const Columns& at) {
  const double highest = at.z.abs().maxCoeff();
  const double most = highest > 0 ? max_bend / highest : 0;
  const Column first =
      std::abs(k.values[0]) * (k.vectors(0, 0) * at.x + k.vectors(1, 0) * at.y).square();
  const Column second =
      std::abs(k.values[1]) * (k.vectors(0, 1) * at.x + k.vectors(1, 1) * at.y).square();
  // 0 / 0 if neither contributes
  const Column m = (first * k.values[0] + second * k.values[1]) / (first + second).max(tiny);
  return 0.5 * m.max(-most).min(most) * at.z.square();
}

Coefficients solve_quadric(const Columns& at, const Column& weights, const Principal& before) {
  const Column &x = at.x, &y = at.y, f = at.z - rounding_up(before, at);
  const Column wx = weights * x, wy = weights * y, wxx = wx * x, wxy = wx * y, wyy = wy * y;
  // sums of x^i y^j
  const double s00 = weights.sum(), s10 = wx.sum(), s01 = wy.sum();
  const double s20 = wxx.sum(), s11 = wxy.sum(), s02 = wyy.sum();
  const double s30 = (wxx * x).sum(), s21 = (wxx * y).sum(), s12 = (wyy * x).sum(),
               s03 = (wyy * y).sum();
  const double s40 = (wxx * x * x).sum(), s31 = (wxx * x * y).sum(), s22 = (wxx * y * y).sum(),
               s13 = (wyy * y * x).sum(), s04 = (wyy * y * y).sum();
  Eigen::Matrix<double, 6, 6> normal;
  normal << s00, s10, s01, s20 / 2, s11, s02 / 2,            //
      s10, s20, s11, s30 / 2, s21, s12 / 2,                  //
      s01, s11, s02, s21 / 2, s12, s03 / 2,                  //
      s20 / 2, s30 / 2, s21 / 2, s40 / 4, s31 / 2, s22 / 4,  //
      s11, s21, s12, s31 / 2, s22, s13 / 2,                  //
      s02 / 2, s12 / 2, s03 / 2, s22 / 4, s13 / 2, s04 / 4;
  Coefficients right;
  right << (weights * f).sum(), (wx * f).sum(), (wy * f).sum(), (wxx * f).sum() / 2,
      (wxy * f).sum(), (wyy * f).sum() / 2;
  normal.diagonal().array() += ridge * static_cast<double>(x.size());
  return solve_symmetric(normal, right);
}

}  // namespace

void measure_fit(PointSpan points, const Vector3d& origin, SurfaceFit& fit,
                 std::span<const double> weights) {
  Matrix3d axes;
  axes << fit.directions, fit.normal;
  const Column w = weight_column(weights, points.size());
  const double total = w.sum();
  Columns at(points.size());
  move_into(axes, origin, 1, points, at);
  const Principal k = {fit.curvatures, Eigen::Matrix2d::Identity()};
  const Column height =
      0.5 * (fit.curvatures[0] * at.x.square() + fit.curvatures[1] * at.y.square()) +
      rounding_up(k, at);
  const double mean = (w * at.z).sum() / total;
  fit.residual = std::sqrt((w * (at.z - height).square()).sum() / total);
  fit.relief = std::sqrt((w * (at.z - mean).square()).sum() / total);
}

SurfaceFit fit_quadric(PointSpan points, double scale, std::span<const double> weights) {
  if (points.size() < 3)
    fail("contact patch: a surface needs at least 3 points, got {}", points.size());
  Matrix3d axes = Matrix3d::Identity();  // columns: the tangent frame
  Vector3d origin = Vector3d::Zero();
  Principal now = principal(0, 0, 0);
  const Column w = weight_column(weights, points.size());
  Columns local(points.size());
  for (int round = 0; round < max_fit_rounds; ++round) {
    move_into(axes, origin, scale, points, local);
    const Coefficients c = solve_quadric(local, w, now);
    const Vector2d before = now.values;
    now = principal(c[3], c[4], c[5]);
    const double moved = c.head<3>().cwiseAbs().sum() + (now.values - before).norm();
    if (moved < settled) break;
    // the next tangent frame: at the foot of the fit, along its normal
    origin += axes.col(2) * c[0] * scale;
    const Vector3d normal = axes * Vector3d(-c[1], -c[2], 1).normalized();
    axes = shortest_rotation(axes.col(2), normal).toRotationMatrix() * axes;
  }
  SurfaceFit fit;
  fit.curvatures = now.values / scale;
  fit.directions = axes.leftCols<2>() * now.vectors;
  fit.normal = axes.col(2);
  measure_fit(points, origin, fit, weights);
  return fit;
}

}  // namespace clench
