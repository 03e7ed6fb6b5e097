#include "clench/io/mjcf/joints/mjcf_drives.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clench/base/disjoint_sets.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/io/mjcf/joints/mjcf_ties.h"
#include "clench/spec/dof_drive.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace {

std::string range_text(double low, double high) {
  return fmt::format("[{:.6g}, {:.6g}]", low, high);
}

/// Entries of a unit row up to this size count as 0.
constexpr double tiny_pull = 1e-6;

void to_unit_length(std::map<int, double>& row) {
  double largest = 0, sum = 0;
  for (const auto& [joint, pull] : row) largest = std::max(largest, std::abs(pull));
  for (const auto& [joint, pull] : row) sum += (pull / largest) * (pull / largest);
  for (auto& [joint, pull] : row) pull = pull / largest / std::sqrt(sum);
  std::erase_if(row, [](const auto& entry) { return std::abs(entry.second) <= tiny_pull; });
}

/// True if two unit rows are equal up to their sign.
bool in_one_ratio(const std::map<int, double>& a, const std::map<int, double>& b) {
  const double sign = (a.begin()->second < 0) == (b.begin()->second < 0) ? 1 : -1;
  return std::ranges::equal(a, b, [&](const auto& x, const auto& y) {
    return x.first == y.first && std::abs(x.second - sign * y.second) <= tiny_pull;
  });
}

class Drives {
 public:
  Drives(const std::vector<MjcfDrive>& drives, MjcfDocument& document, const FileCache& cache,
         TreeModel& tree)
      : drives_(drives), document_(document), cache_(cache), tree_(tree) {
    for (const MjcfDrive& drive : drives) specs_.push_back(drive.actuator.spec);
  }
  void take_control_ranges();
  void tie_joints();
  void set_motors();

 private:
  static Place place_of(const MjcfDrive& drive) {
    return drive.actuator.values.element().place().of(excerpt(drive.actuator.spec.kind));
  }
  ActuatorSpec& spec(const MjcfDrive& drive) {
    return specs_[static_cast<size_t>(&drive - drives_.data())];
  }
  std::map<int, double> pulls(const MjcfDrive& drive) const;
  void inherit_range(const MjcfDrive& drive, std::array<double, 2> target);
  void take_control_range(const MjcfDrive& drive);
  void tie(const MjcfDrive& drive);
  void tell_independent(const std::vector<int>& group);
  void tell_powerless() const;
  void tell_disabled() const;
  void attach(const MjcfDrive& drive);
  void take_gains(const MjcfDrive& drive);

  const std::vector<MjcfDrive>& drives_;
  MjcfDocument& document_;
  const FileCache& cache_;
  TreeModel& tree_;
  std::vector<ActuatorSpec> specs_;  // one per drive
  std::vector<std::string> narrowed_;
};

/// Forces on the joints per unit force of the actuator, before its gear.
std::map<int, double> Drives::pulls(const MjcfDrive& drive) const {
  const double gear = drive.actuator.spec.gear;
  std::map<int, double> out;
  if (!drive.tendon) return {{drive.joint, gear}};
  for (const auto& [number, coefficient] : drive.tendon->joints) out[number] += gear * coefficient;
  return out;
}

// --- ranges of controls ---

/// Clamps the target of a position servo to the range of its controls.
void Drives::take_control_range(const MjcfDrive& drive) {
  const MjcfActuator& actuator = drive.actuator;
  const auto& range = spec(drive).control_range;
  if (actuator.spec.kind != "position" || !range || actuator.spec.gear == 0) return;
  TreeJoint& joint = tree_.joints[drive.joint];
  // a joint that does not move has no range to inherit
  if (joint.min == joint.max) return;
  const double a = (*range)[0] / actuator.spec.gear, b = (*range)[1] / actuator.spec.gear;
  double low = std::min(a, b), high = std::max(a, b);
  if (!joint.endless) low = std::max(joint.min, low), high = std::min(joint.max, high);
  if (low > high || (low == high && (*range)[0] < (*range)[1]))
    return cache_.diagnostics().warn(
        place_of(drive), "ctrlrange has nothing in common with the range of joint '{}'; not used",
        excerpt(joint.name));
  if (low == high)
    cache_.diagnostics().note(actuator.values.element().place(),
                              "joint '{}' is fixed at {:.4g} because of ctrlrange",
                              excerpt(joint.name), low);
  if (joint.endless || low > joint.min || high < joint.max) narrowed_.push_back(joint.name);
  joint.min = low, joint.max = high, joint.endless = false;
  joint.motor.default_value = std::clamp(joint.motor.default_value, low, high);
}

/// Scales the range of the target by inheritrange about its center.
void Drives::inherit_range(const MjcfDrive& drive, std::array<double, 2> target) {
  const double center = 0.5 * (target[0] + target[1]),
               half = 0.5 * (target[1] - target[0]) * drive.actuator.inherit_range;
  // the activation of an integrator
  auto& range =
      spec(drive).activation_range ? spec(drive).activation_range : spec(drive).control_range;
  range = {center - half, center + half};
}

void Drives::take_control_ranges() {
  for (const MjcfDrive& drive : drives_) {
    if (drive.actuator.inherit_range > 0) {
      const ActuatorSpec& own = drive.actuator.spec;
      const bool integrates = own.activation_range.has_value();
      const bool on_joint = !drive.tendon && !tree_.joints[drive.joint].endless;
      const bool on_tendon = drive.tendon && drive.tendon->values.has("range");
      if (integrates ? drive.actuator.values.has("actrange") : own.control_range.has_value())
        cache_.diagnostics().warn(place_of(drive),
                                  "expected either {0} or inheritrange, got both; {0} is used",
                                  integrates ? "actrange" : "ctrlrange");
      else if (on_joint)
        inherit_range(drive, {tree_.joints[drive.joint].min, tree_.joints[drive.joint].max});
      else if (on_tendon)
        inherit_range(drive, drive.tendon->values.range("range", document_.repairs()));
      else
        cache_.diagnostics().warn(place_of(drive).of("inheritrange"),
                                  "expected a target with a range; not used");
    }
    if (!drive.tendon) take_control_range(drive);
  }
  if (!narrowed_.empty())
    cache_.diagnostics().note(Place(document_.file()), "joints whose range ctrlrange narrows: {}",
                              some_names(narrowed_));
}

// --- joints that share a tendon ---

/// Couples the joints of a tendon in proportion to their coefficients.
void Drives::tie(const MjcfDrive& drive) {
  const MjcfTendon& tendon = *drive.tendon;
  const XmlElement& at = drive.actuator.values.element();
  // the coefficients of joints coupled by other elements may cancel
  std::map<int, double> arms;
  for (const auto& [number, c] : tendon.joints)
    if (const TiedJoint tied = by_leader(tree_, number); tied.leader >= 0)
      arms[tied.leader] += c * tied.ratio;
  const auto counts = [&](const auto& part) {
    return std::abs(arms[leader_of(tree_, part.first)]) > 1e-12;
  };
  const auto found = std::ranges::find_if(tendon.joints, counts);
  if (found == tendon.joints.end()) return;
  const auto [first, c_first] = *found;
  const int leader = leader_of(tree_, first);
  for (const auto& part : tendon.joints) {
    const auto& [number, c] = part;
    TreeJoint& joint = tree_.joints[number];
    if (number == first || joint.leader >= 0 || leader_of(tree_, number) == leader || !counts(part))
      continue;
    const double ratio = c / c_first;
    const TreeJoint& lead = tree_.joints[first];
    const double offset = joint.zero - ratio * lead.zero;
    tie_joint(tree_, number, first, ratio, offset, at, cache_);
    std::string narrowed;
    const double a = (joint.min - offset) / ratio, b = (joint.max - offset) / ratio;
    const double low = std::max(lead.min, std::min(a, b)),
                 high = std::min(lead.max, std::max(a, b));
    if (!joint.endless && low <= high && (low > lead.min + 1e-9 || high < lead.max - 1e-9))
      narrowed = fmt::format("; the range of '{}' narrows from {} to {}", excerpt(lead.name),
                             lead.endless ? "no limits" : range_text(lead.min, lead.max),
                             range_text(low, high));
    cache_.diagnostics().warn(at.place(),
                              "joints '{}' and '{}' share a tendon, '{}', and become one DOF; "
                              "their ratio is assumed to be 1 to {:.4g}{}",
                              excerpt(lead.name), excerpt(joint.name), excerpt(tendon.name), ratio,
                              narrowed);
  }
}

void Drives::tell_independent(const std::vector<int>& group) {
  std::vector<std::string> tendons, joints;
  std::set<std::string> known;
  const MjcfDrive* first = nullptr;
  const auto in_group = [&](const auto& part) {
    return std::ranges::binary_search(group, leader_of(tree_, part.first));
  };
  for (const MjcfDrive& drive : drives_) {
    check_stop();
    if (!drive.tendon || std::ranges::none_of(drive.tendon->joints, in_group)) continue;
    if (!first) first = &drive;
    if (known.insert(drive.tendon->name).second) tendons.push_back(drive.tendon->name);
  }
  for (const int joint : group) joints.push_back(tree_.joints[joint].name);
  cache_.diagnostics().warn(first->actuator.values.element().place(),
                            "actuators pull joints in different ratios; each of these joints stays "
                            "a DOF with its own motor; contact forces are those of the actuators, "
                            "while motors of a run are independent: joints {}; tendons {}",
                            some_names(joints), some_names(tendons));
}

void Drives::tie_joints() {
  const size_t count = tree_.joints.size();
  // joints, by the DOF that they would have without tendons
  DisjointSets groups(count);
  std::vector<std::map<int, double>> rows;
  for (const MjcfDrive& drive : drives_) {
    check_stop();
    std::map<int, double> row;
    for (const auto& [joint, pull] : pulls(drive)) {
      const TiedJoint tied = by_leader(tree_, joint);
      if (tied.leader >= 0) row[tied.leader] += pull * tied.ratio;
    }
    std::erase_if(row, [](const auto& entry) { return std::abs(entry.second) < 1e-12; });
    for (const auto& [leader, pull] : row) groups.join(row.begin()->first, leader);
    rows.push_back(std::move(row));
  }
  std::map<int, std::vector<int>> members;
  for (int j = 0; j < static_cast<int>(count); ++j)
    if (leader_of(tree_, j) == j) members[groups.find(j)].push_back(j);
  std::map<int, std::vector<size_t>> rows_of;
  for (size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].empty()) continue;
    rows_of[groups.find(rows[r].begin()->first)].push_back(r);
    to_unit_length(rows[r]);
  }
  for (const auto& [root, group] : members) {
    if (group.size() < 2) continue;
    const std::vector<size_t>& of_group = rows_of[root];
    const auto parallel = [&](size_t r) { return in_one_ratio(rows[of_group[0]], rows[r]); };
    if (!std::ranges::all_of(of_group, parallel)) {
      tell_independent(group);
      continue;
    }
    for (const size_t r : of_group)
      if (drives_[r].tendon) tie(drives_[r]);
  }
}

// --- motors ---

/// Gains of actuators that control the position of a DOF and damp it, summed over all of them.
void Drives::take_gains(const MjcfDrive& drive) {
  const ActuatorSpec& servo = drive.actuator.spec;
  if (!servo.law_known) return;
  // change of the actuator's length per unit of each DOF
  std::map<int, double> reach;
  for (const auto& [joint, pull] : pulls(drive)) {
    const TiedJoint tied = by_leader(tree_, joint);
    if (tied.leader >= 0) reach[tied.leader] += pull * tied.ratio;
  }
  for (const auto& [leader, r] : reach) {
    DofSpec& motor = tree_.joints[leader].motor;
    motor.kp += std::max(0.0, -servo.bias[1]) * r * r;
    motor.kd += std::max(0.0, -servo.bias[2]) * r * r;
    motor.damping_ratio = std::max(motor.damping_ratio, servo.damping_ratio);
  }
}

/// Name of an actuator for messages.
std::string label(const ActuatorSpec& spec) {
  return !spec.name.empty() ? spec.name : !spec.joint.empty() ? spec.joint : spec.tendon;
}

void Drives::tell_powerless() const {
  std::vector<std::string> names;
  Place place;
  for (const MjcfDrive& drive : drives_) {
    const ActuatorSpec& spec = specs_[static_cast<size_t>(&drive - drives_.data())];
    const bool fixed =
        !drive.tendon && tree_.joints[drive.joint].effort_range == std::array{0.0, 0.0};
    if (!spec.enabled || !(fixed || is_powerless(spec))) continue;
    if (names.empty()) place = drive.actuator.values.element().place();
    names.push_back(label(spec));
  }
  if (!names.empty())
    cache_.diagnostics().warn(
        place,
        "actuators that exert no force, because their gear, gain or range is 0, drive nothing: {}",
        some_names(names));
}

void Drives::tell_disabled() const {
  std::vector<std::string> names;
  for (const ActuatorSpec& spec : specs_)
    if (!spec.enabled) names.push_back(label(spec));
  if (names.empty()) return;
  const MjcfActuatorSwitches switches = read_actuator_switches(document_);
  cache_.diagnostics().warn(
      switches.place, "{} switches actuators off; they drive nothing: {}",
      switches.all_off ? "flag: actuation=\"disable\"" : "actuatorgroupdisable", some_names(names));
}

/// Completes the actuator's spec by its target, and adds it to those of the tree. An actuator of a
/// fixed joint drives nothing.
void Drives::attach(const MjcfDrive& drive) {
  ActuatorSpec out = spec(drive);
  const auto add = [&](int joint, double coefficient) {
    const TiedJoint tied = by_leader(tree_, joint);
    if (tied.leader < 0) return;
    out.length_at_0 += out.gear * coefficient * tied.offset;
    if (tied.ratio == 0) return;
    if (out.dof < 0) out.dof = joint;
    tree_.joints[tied.leader].motor.driven = true;
    if (drive.tendon) out.pulls.push_back({tree_.joints[joint].name, coefficient});
  };
  if (!drive.tendon) add(drive.joint, 1);
  if (drive.tendon) {
    for (const auto& [joint, coefficient] : drive.tendon->joints) add(joint, coefficient);
    out.tendon_force_range = drive.tendon->force_range;
  }
  tree_.actuators.push_back(std::move(out));
}

void Drives::set_motors() {
  tell_disabled();
  tell_powerless();
  for (TreeJoint& joint : tree_.joints) joint.motor.driven = false;
  for (const MjcfDrive& drive : drives_) {
    if (drive.actuator.spec.enabled) take_gains(drive);
    attach(drive);
  }
}

}  // namespace

void apply_mjcf_drives(const std::vector<MjcfDrive>& drives, MjcfDocument& document,
                       const FileCache& cache, TreeModel& tree) {
  Drives all(drives, document, cache, tree);
  all.take_control_ranges();
  all.tie_joints();
  all.set_motors();
}

}  // namespace clench
