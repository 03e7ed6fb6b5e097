#include "clench/model/dof.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/base/text.h"

namespace clench {

// a limit that went through degrees and back is still the limit
static constexpr double limit_rounding = 1e-9;

std::string dof_name(const Robot& robot, int dof) {
  const std::string& name = robot.dofs[dof].name;
  return name.empty() ? fmt::format("dof{}", dof + 1) : name;
}

bool dof_slides(const Robot& robot, int dof) {
  const auto first = std::ranges::find(robot.joints, dof, &Joint::dof);
  return first != robot.joints.end() && first->kind == JointKind::prismatic;
}

// what the value may have been meant as, when that lies within the limits
static std::string other_unit(const std::array<double, 2>& range, double value, bool slides) {
  const double meant = slides ? value / 1000 : value * std::numbers::pi / 180;
  if (std::abs(value) < 1 || meant < range[0] - limit_rounding || meant > range[1] + limit_rounding)
    return "";
  const char *unit = slides ? "millimetres" : "degrees", *function = slides ? "mm" : "rad";
  return fmt::format("; {}? clench.{}({:.6g}) is {:.4g}", unit, function, value, meant);
}

std::array<double, 2> range_around(const Robot& robot, int dof, double value) {
  const auto [low, high] = robot.limits[dof];
  if (!robot.endless[dof] || !std::isfinite(value)) return {low, high};
  return {value - (high - low) / 2, value + (high - low) / 2};
}

double within_limits(const Robot& robot, int dof, double value, std::string_view subject) {
  const auto [low, high] = range_around(robot, dof, value);
  const double slack = limit_rounding * std::max({1.0, std::abs(low), std::abs(high)});
  if (value >= low - slack && value <= high + slack) return std::clamp(value, low, high);
  const std::string& name = robot.dofs[dof].name;
  std::string label = fmt::format("DOF {}", dof + 1);
  if (!name.empty()) label = fmt::format("{} {}", label, in_quotes(name));
  const std::string place = fmt::format("{} '{}': {}", subject, excerpt(robot.name), label);
  if (!std::isfinite(value)) fail("{} must be finite, got {}", place, value);
  // as few digits as tell the value from the limit
  int shown = 4;
  const auto text = [&](double x) { return fmt::format("{:.{}g}", x, shown); };
  while (shown < 17 && (text(value) == text(low) || text(value) == text(high))) ++shown;
  const bool slides = dof_slides(robot, dof);
  fail("{} must lie in [{}, {}] {}, got {}{}", place, text(low), text(high), slides ? "m" : "rad",
       text(value), other_unit({low, high}, value, slides));
}

void check_dof_numbers(const Robot& robot, std::span<const int> dofs, std::string_view subject) {
  const int count = static_cast<int>(robot.dofs.size());
  for (const int dof : dofs)
    if (dof < 0 || dof >= count)
      fail("{} of '{}': expected DOFs from 1 to {}, got {}", subject, excerpt(robot.name), count,
           dof + 1);
}

}  // namespace clench
