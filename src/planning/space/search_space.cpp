#include "clench/planning/space/search_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/dof.h"

namespace clench {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

constexpr double wrist_range = pi / 3;

Pose axis_angle_pose(const Eigen::Ref<const Values>& v) {
  const Vector3d axis(std::sin(v[3]) * std::cos(v[4]), std::sin(v[3]) * std::sin(v[4]),
                      std::cos(v[3]));
  return Pose::translation(v.head<3>()) * Pose::turn(v[5], axis);
}

Pose complete_pose(const Eigen::Ref<const Values>& v) {
  Quaterniond q(v[3], v[4], v[5], v[6]);
  // an arbitrary choice if there is no direction
  if (!(q.norm() > 1e-9)) q = Quaterniond::Identity();
  return {q.normalized(), v.head<3>()};
}

// x and y of a frame with given z: y along z x e1, as in the ellipsoid's frames
Quaterniond frame_about(const Vector3d& z) {
  Vector3d y = z.cross(Vector3d::UnitX());
  if (!(y.norm() > 1e-9)) y = Vector3d::UnitY();
  y.normalize();
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  return Quaterniond(axes).normalized();
}

// v  beta, gamma, tau, dist
Pose ellipsoid_pose(const Eigen::Ref<const Values>& v, const Vector3d& semi) {
  const double b = v[0], g = v[1];
  const Vector3d p = semi.cwiseProduct(
      Vector3d(std::cos(b) * std::cos(g), std::cos(b) * std::sin(g), std::sin(b)));
  const Vector3d n = -p.cwiseQuotient(semi.cwiseAbs2()).normalized();
  return Pose{frame_about(n), p - v[3] * n} * Pose::turn(v[2], Vector3d::UnitZ());
}

// the point whose inward normal is the frame's z, the distance from it, and the roll angle
void find_ellipsoid(const Pose& X_RA, const Vector3d& semi, Eigen::Ref<Values> out) {
  const Vector3d n = turned(X_RA.rotation, Vector3d::UnitZ());
  const Vector3d p = -n.cwiseProduct(semi.cwiseAbs2()) / n.cwiseProduct(semi).norm();
  out[0] = std::asin(std::clamp(p.z() / semi.z(), -1.0, 1.0));
  out[1] = std::atan2(p.y() / semi.y(), p.x() / semi.x());
  const Vector3d x = turned(frame_about(n).conjugate(), turned(X_RA.rotation, Vector3d::UnitX()));
  out[2] = std::atan2(x.y(), x.x());
  out[3] = (p - X_RA.position).dot(n);
}

// v  dist, wrist_1, wrist_2
Pose approach_tilt(const Eigen::Ref<const Values>& v) {
  return Pose::turn(v[2], Vector3d::UnitY()) * Pose::turn(v[1], Vector3d::UnitX()) *
         Pose::translation({0, 0, v[0]});
}

void find_approach_tilt(const Pose& X, Eigen::Ref<Values> out) {
  const Vector3d z = turned(X.rotation, Vector3d::UnitZ());
  out[0] = X.position.dot(z);
  out[1] = std::asin(std::clamp(-z.y(), -1.0, 1.0));
  out[2] = std::atan2(z.x(), z.z());
}

void find_axis_angle(const Pose& X, Eigen::Ref<Values> out) {
  Quaterniond q = X.rotation;
  if (q.w() < 0) q.coeffs() *= -1;
  const Vector3d axis = q.vec();
  out.head<3>() = X.position;
  out[3] = std::atan2(std::hypot(axis.x(), axis.y()), axis.z());
  out[4] = axis.head<2>().isZero(0) ? 0 : std::atan2(axis.y(), axis.x());
  out[5] = X.angle();
}

}  // namespace

SearchSpace::SearchSpace(const Robot& hand, const HandState& start, const SpaceOptions& options)
    : options_(options), start_(start), X_HA_(hand.X_BA), eigengrasps_(hand) {
  for (const double axis : options.semi_axes)
    if (!(std::isfinite(axis) && axis > 0))
      fail("search space: semi-axes: expected lengths > 0 [m], got {}", axis);
  for (int d = 0; d < start_.dofs.size(); ++d)
    limits_.push_back(range_around(hand, d, start_.dofs[d]));
  for (int d = 0; d < static_cast<int>(hand.dofs.size()); ++d)
    dof_names_.push_back(dof_name(hand, d));
  add_posture();
  position_begin_ = static_cast<int>(variables_.size());
  add_position();
  own_begin_ = static_cast<int>(variables_.size());
}

void SearchSpace::add_posture() {
  if (options_.posture == PostureKind::fixed) return;
  const bool amplitudes = options_.posture == PostureKind::eigengrasps;
  const std::vector<Range> ranges = amplitudes ? eigengrasps_.range() : limits_;
  const Eigen::VectorXd now =
      amplitudes ? eigengrasps_.amplitudes(start_.dofs) : Eigen::VectorXd(start_.dofs);
  for (size_t i = 0; i < ranges.size(); ++i) {
    auto [low, high] = ranges[i];
    const double at = now[static_cast<int>(i)];
    // for joints without stops: one turn about their present position
    const bool endless = !std::isfinite(high - low);
    if (endless) low = std::max(low, at - pi), high = std::min(high, at + pi);
    Variable v{.name = amplitudes ? fmt::format("EG {}", i) : dof_names_[i],
               .min = low,
               .max = high,
               .value = std::clamp(at, low, high),
               .jump = (high - low) / (amplitudes ? 4 : 2),
               .circular = endless && high - low >= 2 * pi};
    if (!(v.jump > 0)) v.jump = 1, v.fixed = true;
    variables_.push_back(std::move(v));
  }
}

void SearchSpace::add_position() {
  const auto add = [&](const char* name, double min, double max, double value, double jump,
                       bool circular = false) {
    variables_.push_back(
        {.name = name, .min = min, .max = max, .value = value, .jump = jump, .circular = circular});
  };
  switch (options_.position) {
    case PositionKind::complete:
      add("Tx", -0.25, 0.25, 0, 0.1);
      add("Ty", -0.25, 0.25, 0, 0.1);
      add("Tz", -0.25, 0.25, 0.25, 0.1);
      add("Qw", -5, 5, 0.7071, 1);
      add("Qx", -5, 5, 0, 1);
      add("Qy", -5, 5, 0.7071, 1);
      add("Qz", -5, 5, 0, 1);
      break;
    case PositionKind::axis_angle:
      add("Tx", -0.25, 0.25, 0, 0.15);
      add("Ty", -0.25, 0.25, 0, 0.15);
      add("Tz", -0.25, 0.35, 0.35, 0.15);
      add("theta", 0, pi, 0, pi / 5);
      add("phi", -pi, pi, 0, pi / 2, true);
      add("alpha", 0, pi, pi / 2, pi / 2);
      break;
    case PositionKind::ellipsoid:
      add("beta", -pi / 2, pi / 2, 0, pi / 2);
      add("gamma", -pi, pi, 0, pi, true);
      add("tau", -pi, pi, 0, pi, true);
      add("dist", -0.05, 0.1, 0, 0.05);
      break;
    case PositionKind::approach:
      add("dist", -0.03, 0.2, 0, 0.1);
      add("wrist_1", -wrist_range, wrist_range, 0, pi / 6);
      add("wrist_2", -wrist_range, wrist_range, 0, pi / 6);
      break;
    case PositionKind::fixed:
      break;
  }
}

void SearchSpace::add_variable(Variable variable) {
  variables_.push_back(std::move(variable));
  check();
}

void SearchSpace::check() const {
  std::set<std::string_view> names;
  for (const Variable& variable : variables_) {
    check_variable(variable);
    if (!names.insert(variable.name).second)
      fail("search variable '{}': the name is used twice", excerpt(variable.name));
  }
}

Values SearchSpace::start() const {
  Values out(variables_.size());
  for (int i = 0; i < out.size(); ++i) out[i] = variables_[i].value;
  return out;
}

Pose SearchSpace::position(const Values& all) const {
  const auto v = all.segment(position_begin_, own_begin_ - position_begin_);
  switch (options_.position) {
    case PositionKind::complete:
      return complete_pose(v);
    case PositionKind::axis_angle:
      return axis_angle_pose(v) * X_HA_.inverse();
    case PositionKind::ellipsoid:
      return ellipsoid_pose(v, options_.semi_axes) * X_HA_.inverse();
    case PositionKind::approach:
      return start_.X_RH * X_HA_ * approach_tilt(v) * X_HA_.inverse();
    case PositionKind::fixed:
      break;
  }
  return start_.X_RH;
}

HandState SearchSpace::state(const Values& given) const {
  Values v = given;
  for (int i = 0; i < v.size(); ++i) v[i] = inside(variables_[i], given[i]);
  HandState out{position(v), start_.dofs};
  if (options_.posture == PostureKind::eigengrasps)
    out.dofs = eigengrasps_.posture(v.head(position_begin_));
  else if (options_.posture == PostureKind::dofs)
    out.dofs = v.head(position_begin_);
  for (int d = 0; d < out.dofs.size(); ++d)
    out.dofs[d] = std::clamp(out.dofs[d], limits_[d][0], limits_[d][1]);
  return out;
}

void SearchSpace::find_position(const Pose& X_RH, Values& all) const {
  auto out = all.segment(position_begin_, own_begin_ - position_begin_);
  switch (options_.position) {
    case PositionKind::complete:
      out.head<3>() = X_RH.position;
      out.tail<4>() << X_RH.rotation.w(), X_RH.rotation.vec();
      break;
    case PositionKind::axis_angle:
      find_axis_angle(X_RH * X_HA_, out);
      break;
    case PositionKind::ellipsoid:
      find_ellipsoid(X_RH * X_HA_, options_.semi_axes, out);
      break;
    case PositionKind::approach:
      find_approach_tilt((start_.X_RH * X_HA_).inverse() * X_RH * X_HA_, out);
      break;
    case PositionKind::fixed:
      break;
  }
}

Values SearchSpace::values(const HandState& state) const {
  Values out = start();
  if (options_.posture == PostureKind::eigengrasps)
    out.head(position_begin_) = eigengrasps_.amplitudes(state.dofs);
  else if (options_.posture == PostureKind::dofs)
    out.head(position_begin_) = state.dofs;
  find_position(state.X_RH, out);
  for (int i = 0; i < own_begin_; ++i) out[i] = inside(variables_[i], out[i]);
  return out;
}

double SearchSpace::posture_distance(const HandState& a, const HandState& b) const {
  double out = 0;
  for (int d = 0; d < a.dofs.size(); ++d) {
    const double range = limits_[d][1] - limits_[d][0];
    if (std::isfinite(range) && range > 0)
      out = std::max(out, std::abs(a.dofs[d] - b.dofs[d]) / range);
  }
  return out;
}

double SearchSpace::distance(const HandState& a, const HandState& b, double radius,
                             bool posture) const {
  const Eigen::Vector3d p_a = a.X_RH * X_HA_.position, p_b = b.X_RH * X_HA_.position;
  const double place =
      std::max((p_a - p_b).norm() / radius, 0.5 * (a.X_RH.inverse() * b.X_RH).angle() / pi);
  return posture ? std::max(place, posture_distance(a, b)) : place;
}

bool SearchSpace::alike(const HandState& a, const HandState& b, double radius, bool posture,
                        double limit) const {
  if (posture && !(posture_distance(a, b) < limit)) return false;
  return distance(a, b, radius, false) < limit;
}

}  // namespace clench
