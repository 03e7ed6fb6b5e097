#include "clench/model/dof.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/base/text.h"

namespace clench {

// tolerance for limits that were stored in 32 bits or converted to degrees and back: eight times half
// a unit in the last place
static constexpr double limit_rounding = 0x1p-21;

std::string dof_name(const Robot& robot, int dof) {
  const std::string& name = robot.dofs[dof].name;
  return name.empty() ? fmt::format("dof{}", dof + 1) : name;
}

std::vector<std::string> joint_names(const Robot& robot) {
  std::vector<NumberedJoint> joints(robot.joints.size());
  for (size_t c = 0; c < robot.chains.size(); ++c) {
    int number = 0;
    for (const int j : joints_of(robot, robot.chains[c]))
      joints[static_cast<size_t>(j)] = {static_cast<int>(c), number++, &robot.joints[j]};
  }
  return joint_names_of(joints, robot.dofs);
}

bool dof_slides(const Robot& robot, int dof) {
  const auto first = std::ranges::find(robot.joints, dof, &Joint::dof);
  return first != robot.joints.end() && first->kind == JointKind::prismatic;
}

// a hint at a unit in which the value would lie within the limits; a few radians are unlikely to be
// degrees
static std::string other_unit(const std::array<double, 2>& range, double value, bool slides) {
  const double meant = slides ? value / 1000 : value * std::numbers::pi / 180;
  if (std::abs(value) < (slides ? 1 : 4) || meant < range[0] - limit_rounding ||
      meant > range[1] + limit_rounding)
    return "";
  const char *unit = slides ? "millimeters" : "degrees", *function = slides ? "mm" : "rad";
  return fmt::format("; {}? clench.{}({:.6g}) is {:.4g}", unit, function, value, meant);
}

std::array<double, 2> range_around(const Robot& robot, int dof, double value) {
  const auto [low, high] = robot.limits[dof];
  if (!robot.endless[dof] || !std::isfinite(value)) return {low, high};
  return {value - (high - low) / 2, value + (high - low) / 2};
}

// "robot 'dlr': DOF 3 'thumb_1'"; a joint likewise
static std::string limits_place(const Robot& robot, const char* what, int number,
                                const std::string& name, std::string_view subject) {
  std::string label = fmt::format("{} {}", what, number + 1);
  if (!name.empty()) label = fmt::format("{} {}", label, in_quotes(name));
  return fmt::format("{} '{}': {}", subject, excerpt(robot.name), label);
}

static bool nearly_within(const std::array<double, 2>& range, double value, double excess) {
  const auto [low, high] = range;
  return value >= low - excess && value <= high + excess;
}

// for numbers up to the size of the limits
static double rounding_of(const std::array<double, 2>& range) {
  return limit_rounding * std::max({1.0, std::abs(range[0]), std::abs(range[1])});
}

static double soft_excess(bool slides) { return slides ? soft_excess_distance : soft_excess_angle; }

// value and limits with as few digits as distinguish them
static std::array<std::string, 3> limit_texts(const std::array<double, 2>& range, double value) {
  int shown = 4;
  const auto text = [&](double x) { return fmt::format("{:.{}g}", x, shown); };
  while (shown < 17 && (text(value) == text(range[0]) || text(value) == text(range[1]))) ++shown;
  return {text(range[0]), text(range[1]), text(value)};
}

static void warn_of_excess(const Place& place, const std::array<double, 2>& range, double value,
                           bool slides, const Diagnostics& diagnostics) {
  if (!diagnostics) return;
  const auto texts = limit_texts(range, value);
  diagnostics.warn(place, "{} exceeds the limit {} {}; the limit is used", texts[2],
                   value < range[0] ? texts[0] : texts[1], slides ? "m" : "rad");
}

[[noreturn]] static void refuse_limits(const std::string& place, const std::array<double, 2>& range,
                                       double value, bool slides) {
  if (!std::isfinite(value)) fail("{} must be finite, got {}", place, value);
  const auto texts = limit_texts(range, value);
  fail("{} must lie in [{}, {}] {}, got {}{}", place, texts[0], texts[1], slides ? "m" : "rad",
       texts[2], other_unit(range, value, slides));
}

double within_limits(const Robot& robot, int dof, double value, std::string_view subject) {
  const auto range = range_around(robot, dof, value);
  if (nearly_within(range, value, rounding_of(range))) return std::clamp(value, range[0], range[1]);
  refuse_limits(limits_place(robot, "DOF", dof, robot.dofs[dof].name, subject), range, value,
                dof_slides(robot, dof));
}

double near_limits(const Robot& robot, int dof, double value, const Place& place,
                   const Diagnostics& diagnostics) {
  const auto range = range_around(robot, dof, value);
  const bool slides = dof_slides(robot, dof);
  if (nearly_within(range, value, rounding_of(range)) ||
      !nearly_within(range, value, soft_excess(slides)))
    return within_limits(robot, dof, value, place.before("robot"));
  warn_of_excess(place.of(limits_place(robot, "DOF", dof, robot.dofs[dof].name, "robot")), range,
                 value, slides, diagnostics);
  return std::clamp(value, range[0], range[1]);
}

double joint_near_limits(const Robot& robot, int joint, double position, const Place& place,
                         const Diagnostics& diagnostics) {
  const Joint& j = robot.joints[joint];
  const std::array<double, 2> range = {j.min, j.max};
  if (std::isfinite(position) && (j.endless || nearly_within(range, position, rounding_of(range))))
    return position;
  const bool slides = j.kind == JointKind::prismatic;
  const Place at = place.of(limits_place(robot, "joint", joint, j.name, "robot"));
  if (!nearly_within(range, position, soft_excess(slides)))
    refuse_limits(at.text(), range, position, slides);
  warn_of_excess(at, range, position, slides, diagnostics);
  return std::clamp(position, j.min, j.max);
}

void check_dof_numbers(const Robot& robot, std::span<const int> dofs, std::string_view subject) {
  const int count = static_cast<int>(robot.dofs.size());
  for (const int dof : dofs)
    if (dof < 0 || dof >= count)
      fail("{} of '{}': expected DOFs from 1 to {}, got {}", subject, excerpt(robot.name), count,
           dof + 1);
}

}  // namespace clench
