#include "clench/model/dof_drive.h"

#include <algorithm>
#include <cmath>

namespace clench {

namespace {

constexpr double none = DriveTerm::none;

EffortRange spanned(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

// the range times a factor, without infinity times 0
EffortRange scaled(const EffortRange& range, double factor) {
  if (factor == 0) return {};
  return spanned(range.low * factor, range.high * factor);
}

EffortRange clamped(const EffortRange& range, const std::array<double, 2>& bounds) {
  return {std::clamp(range.low, bounds[0], bounds[1]),
          std::clamp(range.high, bounds[0], bounds[1])};
}

EffortRange range_of(const std::array<double, 2>& bounds) { return {bounds[0], bounds[1]}; }

// at rest, at the actuator's length
EffortRange by_control(const DriveTerm& term, double length) {
  EffortRange force = scaled(range_of(term.control), term.gain);
  const double own = term.bias[0] + term.bias[1] * length;
  force.low += own, force.high += own;
  return clamped(force, term.force);
}

template <class Range>
EffortRange sum(const DofDrive& drive, Range range) {
  EffortRange out = drive.terms.empty() ? EffortRange{-none, none} : EffortRange{};
  for (const DriveTerm& term : drive.terms) {
    const EffortRange effort = scaled(range(term), term.reach);
    out.low += effort.low, out.high += effort.high;
  }
  return drive.max_effort > 0 ? clamped(out, {-drive.max_effort, drive.max_effort}) : out;
}

// --- from a robot ---

double ratio_of(const Robot& robot, const std::string& name, int dof) {
  const auto found = std::ranges::find_if(
      robot.joints, [&](const Joint& joint) { return joint.dof == dof && joint.name == name; });
  return found == robot.joints.end() ? 1 : found->ratio;
}

bool exerts_nothing(const ActuatorSpec& actuator) {
  const bool no_bias = actuator.bias == std::array<double, 3>{0, 0, 0};
  // a damper exerts no force at rest
  return actuator.gear == 0 || (actuator.gain == 0 && no_bias) || actuator.kind == "damper";
}

// from the smaller to the larger, whatever the order of a spec; without bounds where there are none
std::array<double, 2> bounds_of(const std::optional<std::array<double, 2>>& range) {
  if (!range) return {-none, none};
  return {std::min((*range)[0], (*range)[1]), std::max((*range)[0], (*range)[1])};
}

// An actuator on a tendon, whose coefficients are known by the largest effort that they give the DOF
// alone: they count as positive, so that a range on one side of 0 stays there.
DriveTerm on_tendon(const ActuatorSpec& actuator, double max_effort) {
  DriveTerm law;
  if (actuator.law_known) law.gain = actuator.gain, law.bias = actuator.bias;
  if (actuator.law_known) law.control = bounds_of(actuator.control_range);
  law.force = bounds_of(actuator.force_range);
  const EffortRange range = law.is_servo() ? range_of(law.force) : by_control(law, 0);
  const double most = std::max(-range.low, range.high);
  if (range.is_zero()) return {.reach = 0};
  const double scale = max_effort > 0 && most < none ? max_effort / most : std::abs(actuator.gear);
  // the larger end has the limit of the DOF, where there is one
  const auto end = [&](double force) {
    const bool is_larger = std::abs(force) >= most * (1 - 1e-12);
    return is_larger && max_effort > 0 ? std::copysign(none, force) : force * scale;
  };
  DriveTerm out;
  out.reach = actuator.gear < 0 ? -1 : 1;
  out.force = {end(range.low), end(range.high)};
  return out;
}

DriveTerm term_of(const Robot& robot, const ActuatorSpec& actuator) {
  DriveTerm term;
  if (exerts_nothing(actuator)) {
    term.reach = 0;
    return term;
  }
  if (actuator.joint.empty()) return on_tendon(actuator, robot.dofs[actuator.dof].max_effort);
  term.reach = actuator.gear * ratio_of(robot, actuator.joint, actuator.dof);
  term.force = bounds_of(actuator.force_range);
  if (!actuator.law_known) return term;
  term.gain = actuator.gain;
  term.bias = actuator.bias;
  term.control = bounds_of(actuator.control_range);
  return term;
}

}  // namespace

EffortRange DofDrive::at_rest(double q) const {
  return sum(*this, [&](const DriveTerm& term) { return by_control(term, term.reach * q); });
}

EffortRange DofDrive::commanded(double q) const {
  DofDrive free{.terms = terms, .max_effort = 0};
  for (DriveTerm& term : free.terms) term.force = {-none, none};
  return free.at_rest(q);
}

EffortRange DofDrive::limits() const {
  return sum(*this, [](const DriveTerm& term) {
    return term.is_servo() ? range_of(term.force) : by_control(term, 0);
  });
}

bool DofDrive::has_servo() const {
  return std::ranges::any_of(terms, [](const DriveTerm& term) { return term.is_servo(); });
}

bool DofDrive::acts() const {
  const auto controls = [](const DriveTerm& term) { return term.reach != 0 && term.gain != 0; };
  return (terms.empty() || std::ranges::any_of(terms, controls)) && !limits().is_zero();
}

DofDrive drive_of(const Robot& robot, int dof) {
  const DofSpec& spec = robot.dofs[dof];
  DofDrive out{.terms = {}, .max_effort = spec.max_effort};
  if (!spec.driven || !robot.passive) return out;
  for (const ActuatorSpec& actuator : robot.passive->actuators)
    if (actuator.dof == dof) out.terms.push_back(term_of(robot, actuator));
  return out;
}

}  // namespace clench
