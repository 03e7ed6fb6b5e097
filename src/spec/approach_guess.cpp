#include "clench/spec/approach_guess.h"

#include <cmath>
#include <numbers>

#include "clench/spec/ball_trial.h"

namespace clench {

using Eigen::Vector3d;

namespace {

// distance of adjacent lines, relative to the ball's radius
constexpr double spacing = 0.5, extent = 2.5;
constexpr int leaning_sides = 6;
constexpr double leaning = 0.4;  // [rad]
// standard deviation of the bell curve by which a line counts the lines near it, relative to the
// radius
constexpr double beside = 0.5;
constexpr double off_middle = 0.02;  // penalty of a line one radius away from the middle

struct Attempt {
  Vector3d center;  // of the ball
  Vector3d offset;  // from the middle, across the direction
  bool leans;
  double held;
};

// X  +z along the direction, its origin at the middle
std::vector<Attempt> try_all(const BallTrial& trial, const Pose& X) {
  std::vector<Attempt> out;
  const int n = static_cast<int>(extent / spacing);
  for (int side = 0; side <= leaning_sides; ++side) {
    const double turn = 2 * std::numbers::pi * side / leaning_sides;
    const Vector3d axis(std::cos(turn), std::sin(turn), 0);
    const Pose lean = side > 0 ? Pose::turn(leaning, axis) : Pose{};
    const Vector3d direction = turned((X * lean).rotation, Vector3d::UnitZ());
    for (int i = -n; i <= n; ++i)
      for (int j = -n; j <= n; ++j) {
        const Vector3d offset = spacing * trial.radius() * Vector3d(i, j, 0);
        if (const auto center = trial.touch(X * offset, direction))
          out.push_back({*center, offset, side > 0, trial.held(*center)});
      }
  }
  return out;
}

double score(const Attempt& line, const std::vector<Attempt>& all, double radius) {
  double sum = 0, weight = 0;
  for (const Attempt& other : all) {
    const double distance = (line.offset - other.offset).norm() / (beside * radius);
    const double w = std::exp(-0.5 * distance * distance);
    sum += w * std::max(0.0, other.held);
    weight += w;
  }
  return sum / weight - off_middle * line.offset.norm() / radius;
}

}  // namespace

std::optional<Pose> guess_approach(const RobotSpec& robot) {
  const BallTrial trial(robot);
  const auto direction = trial.closes() ? trial.direction() : std::nullopt;
  if (!direction) return {};
  const Pose middle = approach_frame(trial.tips_center(), *direction);
  if (!middle.is_finite()) return {};
  if (!trial.possible()) return middle;
  const auto lines = try_all(trial, middle);
  const Attempt* best = nullptr;
  double most = 0;
  for (const Attempt& line : lines) {
    if (line.leans) continue;
    const double s = score(line, lines, trial.radius());
    if (s > most) most = s, best = &line;
  }
  return best ? approach_frame(best->center, *direction) : middle;
}

}  // namespace clench
