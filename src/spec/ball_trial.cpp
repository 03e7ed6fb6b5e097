#include "clench/spec/ball_trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/base/random.h"
#include "clench/base/watched.h"

namespace clench {

using Eigen::Vector3d;

namespace {

constexpr double ball_size = 0.25;  // its radius, relative to the length of the fingers
constexpr double fineness = 0.3;    // distance of points on a link, relative to the radius
constexpr int min_points = 20, max_points = 400;  // on a link
constexpr int closing_steps = 24;
constexpr double apart = 0.02,
                 // gaps of the approaching ball, and of contacts: relative to the radius
    touching = 0.1;
constexpr double friction_angle = 0.38;  // [rad]
constexpr int directions = 100;          // assumed friction of contacts
constexpr double first_closing = 0.05;   // fraction of the range
constexpr double common = 0.4;           // length of a mean of unit vectors above which they agree
// cosine of 20 degrees: a direction this near to an axis is snapped to it
constexpr double nearly_axis = 0.94;
constexpr double max_work = 1e6;  // points examined in all steps of closing a DOF

// i of n points of a spiral, each representing the same area of the unit sphere
Vector3d on_sphere(int i, int n) {
  const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z);
  const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// points spread over a mesh, at approximately this distance from each other
std::vector<Vector3d> points_on(const Mesh& mesh, double distance, uint64_t seed) {
  std::vector<double> sums = {0};  // of areas
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    sums.push_back(sums.back() + 0.5 * (b - a).cross(c - a).norm());
  }
  if (!(sums.back() > 0) || !std::isfinite(sums.back())) return {};
  const double wanted = std::min(sums.back() / (distance * distance), double{max_points});
  const int count = std::max(static_cast<int>(wanted), min_points);
  Random random(seed);
  std::vector<Vector3d> out;
  for (int i = 0; i < count; ++i) {
    const double at = sums.back() * (i + random.uniform()) / count;
    const auto t = std::upper_bound(sums.begin() + 1, sums.end() - 1, at) - sums.begin() - 1;
    const auto [a, b, c] = mesh.corners(static_cast<int>(t));
    const double r = std::sqrt(random.uniform()), s = random.uniform();
    out.push_back((1 - r) * a + r * (1 - s) * b + r * s * c);
  }
  return out;
}

Vector3d snapped(const Vector3d& direction) {
  Eigen::Index axis;
  const double largest = direction.cwiseAbs().maxCoeff(&axis);
  if (largest < nearly_axis) return direction;
  return std::copysign(1.0, direction[axis]) * Vector3d::Unit(axis);
}

// does any joint of the finger turn?
bool turns(const RobotSpec& robot, const Finger& finger) {
  return std::ranges::any_of(finger.links, [&](int l) {
    return std::ranges::any_of(robot.links[l].joints, [](const JointSpec& joint) {
      return joint.kind == JointKind::revolute;
    });
  });
}

}  // namespace

BallTrial::BallTrial(const RobotSpec& robot) : hand_(hand_tree(robot)), open_(hand_.rest) {
  for (const int dof : hand_.dofs) {
    const double v = robot.dofs[dof].default_velocity;
    const auto [low, high] = hand_.ranges[dof];
    if (v == 0 || hand_.turns_without_end(dof)) continue;
    closing_.push_back({dof, (v > 0 ? 1 : -1) * (high - low) / closing_steps, moved_links(dof)});
    open_.q[dof] = v > 0 ? low : high;
  }
  if (!closes()) return;
  open_.poses = link_poses(robot, open_.q);
  const Span fingers = span();
  // for short fingers, such as those of sliding grippers, the gap between them is used
  radius_ = ball_size * std::max(fingers.mean_length, fingers.min_gap);
  if (!(radius_ > 0) || !std::isfinite(radius_)) return;
  for (int l = -1; l < static_cast<int>(robot.links.size()); ++l) add_part(l);
  double work = 0;
  for (const Closing& c : closing_)
    for (const int l : c.links)
      work += closing_steps * static_cast<double>(part(l).points.size() + 1);
  possible_ = work <= max_work;
}

std::vector<int> BallTrial::moved_links(int dof) const {
  const auto& links = hand_.robot.links;
  std::vector<bool> moved(links.size());
  std::vector<int> out;
  for (int l = 0; l < static_cast<int>(links.size()); ++l) {
    moved[l] = (links[l].parent >= 0 && moved[links[l].parent]) ||
               std::ranges::count(links[l].joints, dof, &JointSpec::dof) > 0;
    if (moved[l]) out.push_back(l);
  }
  return out;
}

void BallTrial::add_part(int link) {
  Part& part = parts_.emplace_back();
  const ShapePtr& shape = drawn(body_of(hand_.robot, link));
  if (!shape) return;
  part.points = points_on(shape->mesh(), fineness * radius_, static_cast<uint64_t>(link + 2));
  part.middle = shape->center();
  part.radius = shape->radius();
}

BallTrial::Span BallTrial::span() const {
  double sum = 0, least = std::numeric_limits<double>::infinity();
  std::vector<Vector3d> tips;
  for (const Finger& finger : hand_.fingers) {
    Vector3d at = open_.at(finger.links.front()).position;
    for (const int l : finger.links) {
      sum += (open_.at(l).position - at).norm();
      at = open_.at(l).position;
    }
    const Vector3d tip = open_.at(finger.tip) * finger.p_tip;
    sum += (tip - at).norm();
    for (const Vector3d& other : tips) least = std::min(least, (tip - other).norm());
    tips.push_back(tip);
  }
  return {sum / static_cast<double>(tips.size()), tips.size() > 1 ? least : 0};
}

Vector3d BallTrial::tips_center() const {
  std::vector<double> q = open_.q;
  for (const Closing& c : closing_) q[c.dof] += 0.5 * closing_steps * c.step;
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : tips_at(hand_, q)) sum += p;
  const Pose X_BP = Posture{q, link_poses(hand_.robot, q)}.at(hand_.palm);
  return X_BP * (sum / static_cast<double>(hand_.fingers.size()));
}

std::optional<Vector3d> BallTrial::direction() const {
  std::vector<double> from = hand_.rest.q, to = from;
  for (const Closing& c : closing_) {
    const double little = first_closing * closing_steps * c.step;
    const auto [low, high] = hand_.ranges[c.dof];
    if (to[c.dof] + little < low || to[c.dof] + little > high) from[c.dof] -= little;
    to[c.dof] = from[c.dof] + little;
  }
  const auto before = tips_at(hand_, from), after = tips_at(hand_, to);
  const Pose X_BP = hand_.rest.at(hand_.palm);
  Vector3d closing = Vector3d::Zero(), pointing = closing;
  for (size_t f = 0; f < before.size(); ++f) {
    closing += (after[f] - before[f]).stableNormalized() / static_cast<double>(before.size());
    const Finger& finger = hand_.fingers[f];
    const Pose& first = hand_.rest.at(finger.links.front());
    if (turns(hand_.robot, finger))
      pointing += (before[f] - X_BP.inverse() * first.position).stableNormalized();
  }
  if (closing.norm() > common) return snapped(X_BP.rotation * closing.normalized());
  if (pointing.norm() > 1e-6) return snapped(X_BP.rotation * pointing.normalized());
  const ShapePtr& palm = drawn(body_of(hand_.robot, hand_.palm));
  const Vector3d out = tips_center() - (palm ? X_BP * palm->center() : X_BP.position);
  if (out.norm() > 1e-9) return snapped(out.normalized());
  return {};
}

std::optional<Vector3d> BallTrial::touch(const Vector3d& from, const Vector3d& direction) const {
  // the point of the hand that the ball touches first
  double farthest = -std::numeric_limits<double>::infinity();
  for (int l = -1; l < static_cast<int>(hand_.robot.links.size()); ++l) {
    check_stop();
    const Pose X_BL = open_.at(l);
    for (const Vector3d& p_L : part(l).points) {
      const Vector3d p = X_BL * p_L - from;
      const double along = direction.dot(p), beside = (p - along * direction).squaredNorm();
      if (beside < radius_ * radius_)
        farthest = std::max(farthest, along + std::sqrt(radius_ * radius_ - beside));
    }
  }
  if (!std::isfinite(farthest)) return {};
  return from + (farthest + apart * radius_) * direction;
}

bool BallTrial::inside(const Posture& at, const std::vector<int>& links,
                       const Vector3d& center) const {
  for (const int l : links) {
    const Vector3d center_L = at.poses[l].inverse() * center;
    if ((part(l).middle - center_L).norm() > part(l).radius + radius_) continue;
    for (const Vector3d& p : part(l).points)
      if ((p - center_L).squaredNorm() < radius_ * radius_) return true;
  }
  return false;
}

// DOF by DOF, one step each, until its links would enter the ball
Posture BallTrial::close_on(const Vector3d& center) const {
  Posture at = open_;
  std::vector<bool> stopped(closing_.size());
  const auto place = [&](const Closing& c) {
    for (const int l : c.links) {
      const LinkSpec& link = hand_.robot.links[l];
      at.poses[l] = at.at(link.parent) * link_in_parent(link, at.q);
    }
  };
  for (int s = 0; s < closing_steps; ++s)
    for (size_t i = 0; i < closing_.size(); ++i) {
      const Closing& c = closing_[i];
      if (stopped[i]) continue;
      check_stop();
      at.q[c.dof] += c.step;
      place(c);
      if (!inside(at, c.links, center)) continue;
      stopped[i] = true;
      at.q[c.dof] -= c.step;
      place(c);
    }
  return at;
}

double BallTrial::held(const Vector3d& center) const {
  const Posture closed = close_on(center);
  const double reach = (1 + touching) * radius_;
  std::vector<Vector3d> contacts;  // seen from the center
  for (int l = -1; l < static_cast<int>(hand_.robot.links.size()); ++l) {
    const Pose X_BL = closed.at(l);
    if ((X_BL * part(l).middle - center).norm() > part(l).radius + reach) continue;
    for (const Vector3d& p_L : part(l).points) {
      const Vector3d d = X_BL * p_L - center;
      if (d.squaredNorm() < reach * reach) contacts.push_back(d.normalized());
    }
  }
  double least = 1;
  for (int i = 0; i < directions; ++i) {
    const Vector3d u = on_sphere(i, directions);
    double nearest = -1;
    for (const Vector3d& n : contacts) nearest = std::max(nearest, n.dot(u));
    const double angle = std::acos(std::min(1.0, nearest)) - friction_angle;
    least = std::min(least, std::cos(std::max(0.0, angle)));
  }
  return least;
}

}  // namespace clench
