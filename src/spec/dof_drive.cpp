#include "clench/spec/dof_drive.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace clench {

namespace {

constexpr double none = DriveTerm::none;

EffortRange spanned(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

// the range times a factor, avoiding infinity times 0
EffortRange scaled(const EffortRange& range, double factor) {
  if (factor == 0) return {};
  return spanned(range.low * factor, range.high * factor);
}

EffortRange clamped(const EffortRange& range, const std::array<double, 2>& bounds) {
  return {std::clamp(range.low, bounds[0], bounds[1]),
          std::clamp(range.high, bounds[0], bounds[1])};
}

EffortRange range_of(const std::array<double, 2>& bounds) { return {bounds[0], bounds[1]}; }

double length_of(const DriveTerm& term, const DofDrive::Dofs& q) {
  double length = term.offset;
  for (const auto& [dof, arm] : term.arms) length += arm * q[dof];
  return length;
}

// over all controls, at rest at the actuator's length
EffortRange by_control(const DriveTerm& term, double length) {
  EffortRange force = scaled(range_of(term.control), term.gain[0] + term.gain[1] * length);
  const double own = term.bias[0] + term.bias[1] * length;
  force.low += own, force.high += own;
  return force;
}

// does it only damp, apart from a constant force?
bool is_damper(const DriveTerm& term) {
  return term.gain[0] == 0 && term.gain[1] == 0 && term.bias[1] == 0;
}

// range of a term's force at any position and velocity
EffortRange limits_of(const DriveTerm& term) {
  return term.is_servo() && !is_damper(term) ? range_of(term.force)
                                             : clamped(by_control(term, 0), term.force);
}

template <class Range>
EffortRange sum(const DofDrive& drive, bool bounded, Range range) {
  EffortRange out = drive.terms.empty() ? EffortRange{-none, none} : EffortRange{};
  std::vector<EffortRange> sums(drive.sums.size());
  for (const DriveTerm& term : drive.terms) {
    const EffortRange effort = scaled(range(term), term.reach);
    EffortRange& into = term.sum < 0 ? out : sums[static_cast<size_t>(term.sum)];
    into.low += effort.low, into.high += effort.high;
  }
  for (size_t i = 0; i < sums.size(); ++i) {
    const EffortRange part = bounded ? clamped(sums[i], drive.sums[i].bounds) : sums[i];
    const EffortRange effort = scaled(part, drive.sums[i].factor);
    out.low += effort.low, out.high += effort.high;
  }
  const bool limited = bounded && drive.max_effort > 0;
  return limited ? clamped(out, {-drive.max_effort, drive.max_effort}) : out;
}

// --- from a robot ---

// sorted bounds, whatever the order in a spec; infinite if absent
std::array<double, 2> bounds_of(const std::optional<std::array<double, 2>>& range) {
  if (!range) return {-none, none};
  return {std::min((*range)[0], (*range)[1]), std::max((*range)[0], (*range)[1])};
}

// the bounds of two successive clamps
std::array<double, 2> then(const std::array<double, 2>& first,
                           const std::array<double, 2>& second) {
  return {std::clamp(first[0], second[0], second[1]), std::clamp(first[1], second[0], second[1])};
}

// law and limits of an actuator, without its transmission
DriveTerm law_of(const ActuatorSpec& actuator) {
  DriveTerm term;
  term.offset = actuator.length_at_0;
  term.force = bounds_of(actuator.force_range);
  if (actuator.law_known) {
    term.gain = {actuator.gain, actuator.gain_slopes[0], actuator.gain_slopes[1]};
    term.bias = actuator.bias;
    term.control =
        bounds_of(actuator.activation_range ? actuator.activation_range : actuator.control_range);
  } else {
    term.force = then(bounds_of(actuator.law_range), term.force);
  }
  return term;
}

// a joint that an actuator pulls
struct Pulled {
  const JointSpec* joint;
  double pull;  // length of the actuator per unit of the joint

  double reach() const { return pull * joint->ratio; }
};

// The actuators of one DOF, and the limits of its joints.
class DriveMaker {
 public:
  DriveMaker(const RobotSpec& robot, int dof) : robot_(robot), dof_(dof) {
    const bool named =
        std::ranges::any_of(robot.actuators, [](auto& a) { return !a.pulls.empty(); });
    each_joint(robot, [&](const JointSpec& joint) {
      if (joint.dof == dof) joints_.push_back(&joint);
      if (named) by_name_.try_emplace(joint.name, &joint);
    });
  }
  DofDrive make();

 private:
  std::vector<Pulled> pulled_by(const ActuatorSpec& actuator) const;
  void add(const ActuatorSpec& actuator);
  void push(DriveTerm term, double reach, int sum = -1);
  int joint_sum(const JointSpec& joint);
  int tendon_sum(const ActuatorSpec& actuator, double reach);

  const RobotSpec& robot_;
  int dof_;
  std::vector<const JointSpec*> joints_;  // of the DOF
  std::map<std::string_view, const JointSpec*> by_name_;
  DofDrive out_;
  std::vector<const JointSpec*> joint_of_sum_;  // null: the sum over a tendon
  std::vector<std::string> tendon_of_sum_;
};

// A joint that is not one of the robot's: it moves no DOF.
std::vector<Pulled> DriveMaker::pulled_by(const ActuatorSpec& actuator) const {
  std::vector<Pulled> out;
  if (!actuator.joint.empty())
    for (const JointSpec* joint : joints_)
      if (joint->name == actuator.joint && joint->dof == dof_) return {{joint, actuator.gear}};
  for (const TendonPull& pull : actuator.pulls)
    if (const auto found = by_name_.find(pull.joint); found != by_name_.end())
      out.push_back({found->second, actuator.gear * pull.coefficient});
  return out;
}

void DriveMaker::push(DriveTerm term, double reach, int sum) {
  term.reach = reach;
  term.sum = sum;
  out_.terms.push_back(std::move(term));
}

int DriveMaker::joint_sum(const JointSpec& joint) {
  const auto found = std::ranges::find(joint_of_sum_, &joint);
  if (found != joint_of_sum_.end()) return static_cast<int>(found - joint_of_sum_.begin());
  out_.sums.push_back({joint.ratio, bounds_of(joint.effort_range)});
  joint_of_sum_.push_back(&joint);
  tendon_of_sum_.emplace_back();
  return static_cast<int>(out_.sums.size()) - 1;
}

// Of actuators with one gear: MuJoCo clamps the sum of forces before the gear.
int DriveMaker::tendon_sum(const ActuatorSpec& actuator, double reach) {
  for (size_t i = 0; i < out_.sums.size(); ++i)
    if (!joint_of_sum_[i] && tendon_of_sum_[i] == actuator.tendon && out_.sums[i].factor == reach)
      return static_cast<int>(i);
  out_.sums.push_back({reach, bounds_of(actuator.tendon_force_range)});
  joint_of_sum_.push_back(nullptr);
  tendon_of_sum_.push_back(actuator.tendon);
  return static_cast<int>(out_.sums.size()) - 1;
}

void DriveMaker::add(const ActuatorSpec& actuator) {
  if (!actuator.joint.empty() && actuator.dof != dof_) return;
  DriveTerm term = law_of(actuator);
  term.actuator = static_cast<int>(&actuator - robot_.actuators.data());
  std::vector<Pulled> pulled = pulled_by(actuator);
  const bool direct = actuator.joint.empty() ? actuator.pulls.empty() : pulled.empty();
  if (direct) term.arms = {{actuator.dof, actuator.gear}};
  for (const Pulled& p : pulled) {
    const auto found = std::ranges::find(term.arms, p.joint->dof, [](auto& a) { return a.first; });
    if (found == term.arms.end())
      term.arms.emplace_back(p.joint->dof, p.reach());
    else if (found->second += p.reach(); std::abs(found->second) < 1e-12 * std::abs(p.reach()))
      found->second = 0;
  }
  const auto own = std::ranges::find(term.arms, dof_, [](auto& arm) { return arm.first; });
  if (own == term.arms.end() || own->first < 0) return;
  const double reach = own->second;
  if (!actuator.enabled || actuator.gear == 0) return push(DriveTerm{}, 0);
  std::erase_if(pulled, [&](const Pulled& p) { return p.joint->dof != dof_; });
  const auto limited = [](const Pulled& p) { return p.joint->effort_range.has_value(); };
  const auto with = [&](const Pulled& p) { return p.reach() * pulled.front().reach() > 0; };
  // joints that pull in opposite directions: the remainder is used
  if (std::ranges::any_of(pulled, limited) && std::ranges::all_of(pulled, with)) {
    if (actuator.tendon_force_range)
      term.force = then(bounds_of(actuator.tendon_force_range), term.force);
    double free = 0;
    for (const Pulled& p : pulled)
      if (limited(p))
        push(term, p.pull, joint_sum(*p.joint));
      else
        free += p.reach();
    if (free != 0) push(term, free);
    return;
  }
  if (!actuator.tendon_force_range) return push(std::move(term), reach);
  const auto on_tendon = [&](const ActuatorSpec& a) {
    return a.enabled && a.tendon == actuator.tendon;
  };
  if (std::ranges::count_if(robot_.actuators, on_tendon) > 1)
    return push(std::move(term), 1, tendon_sum(actuator, reach));
  term.force = then(bounds_of(actuator.tendon_force_range), term.force);
  push(std::move(term), reach);
}

DofDrive DriveMaker::make() {
  out_.max_effort = robot_.dofs[static_cast<size_t>(dof_)].max_effort;
  for (const ActuatorSpec& actuator : robot_.actuators) add(actuator);
  return std::move(out_);
}

}  // namespace

EffortRange DriveTerm::force_at_rest(const Eigen::Ref<const Eigen::VectorXd>& q) const {
  return clamped(by_control(*this, length_of(*this, q)), force);
}

EffortRange DofDrive::at_rest(const Dofs& q) const {
  return sum(*this, true, [&](const DriveTerm& term) { return term.force_at_rest(q); });
}

EffortRange DofDrive::commanded(const Dofs& q) const {
  return sum(*this, false,
             [&](const DriveTerm& term) { return by_control(term, length_of(term, q)); });
}

EffortRange DofDrive::limits() const { return sum(*this, true, limits_of); }

bool DofDrive::has_servo() const {
  return std::ranges::any_of(terms, [](const DriveTerm& term) { return term.is_servo(); });
}

bool DofDrive::acts() const {
  const auto controls = [](const DriveTerm& term) {
    return term.reach != 0 && (term.gain[0] != 0 || term.gain[1] != 0);
  };
  return (terms.empty() || std::ranges::any_of(terms, controls)) && !limits().is_zero();
}

DofDrive drive_of(const RobotSpec& robot, int dof) { return DriveMaker(robot, dof).make(); }

bool is_powerless(const ActuatorSpec& actuator) {
  DofDrive drive;
  drive.terms = {law_of(actuator)};
  if (actuator.tendon_force_range)
    drive.terms[0].force = then(bounds_of(actuator.tendon_force_range), drive.terms[0].force);
  return !actuator.enabled || actuator.gear == 0 || !drive.acts();
}

}  // namespace clench
