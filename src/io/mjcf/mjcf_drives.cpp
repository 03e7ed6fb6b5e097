#include "clench/io/mjcf/mjcf_drives.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "clench/base/disjoint_sets.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/io/mjcf/mjcf_ties.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();

std::string range_text(double low, double high) {
  return fmt::format("[{:.6g}, {:.6g}]", low, high);
}

/// Entries of a row of unit length that count as 0.
constexpr double tiny_pull = 1e-6;

void to_unit_length(std::map<int, double>& row) {
  double largest = 0, sum = 0;
  for (const auto& [joint, pull] : row) largest = std::max(largest, std::abs(pull));
  for (const auto& [joint, pull] : row) sum += (pull / largest) * (pull / largest);
  for (auto& [joint, pull] : row) pull = pull / largest / std::sqrt(sum);
  std::erase_if(row, [](const auto& entry) { return std::abs(entry.second) <= tiny_pull; });
}

/// Are two rows of unit length the same, but for their sign?
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
      : drives_(drives), document_(document), cache_(cache), tree_(tree) {}
  void take_control_ranges();
  void tie_joints();
  void set_motors();

 private:
  void warn(const MjcfDrive& drive, const std::string& what) const {
    cache_.warn(fmt::format("{}: {}: {}", drive.actuator.values.element().place(),
                            excerpt(drive.actuator.spec.kind), what));
  }
  std::map<int, double> pulls(const MjcfDrive& drive) const;
  void inherit_range(const MjcfDrive& drive, std::array<double, 2> target);
  void take_control_range(const MjcfDrive& drive);
  void tie(const MjcfDrive& drive);
  void tell_independent(const std::vector<int>& group);
  void tell_powerless() const;
  void take_gains(const MjcfDrive& drive);

  const std::vector<MjcfDrive>& drives_;
  MjcfDocument& document_;
  const FileCache& cache_;
  TreeModel& tree_;
  std::vector<std::optional<std::array<double, 2>>> control_ranges_;  // one per drive
  std::vector<std::string> narrowed_;
};

/// What the actuator, at unit force before its gear, exerts on joints.
std::map<int, double> Drives::pulls(const MjcfDrive& drive) const {
  const double gear = drive.actuator.spec.gear;
  std::map<int, double> out;
  if (!drive.tendon) return {{drive.joint, gear}};
  for (const auto& [number, coefficient] : drive.tendon->joints) out[number] += gear * coefficient;
  return out;
}

// --- ranges of controls ---

/// A position servo's target is clamped to the range of its controls.
void Drives::take_control_range(const MjcfDrive& drive) {
  const MjcfActuator& actuator = drive.actuator;
  const auto& range = control_ranges_[static_cast<size_t>(&drive - drives_.data())];
  if (actuator.spec.kind != "position" || !range || actuator.spec.gear == 0) return;
  TreeJoint& joint = tree_.joints[drive.joint];
  // a joint that stands still has none to take
  if (joint.min == joint.max) return;
  const double a = (*range)[0] / actuator.spec.gear, b = (*range)[1] / actuator.spec.gear;
  double low = std::min(a, b), high = std::max(a, b);
  if (!joint.endless) low = std::max(joint.min, low), high = std::min(joint.max, high);
  if (low > high || (low == high && (*range)[0] < (*range)[1]))
    return warn(drive, fmt::format("ctrlrange has nothing in common with the range of joint '{}'; "
                                   "not used",
                                   excerpt(joint.name)));
  if (low == high)
    cache_.note(fmt::format("{}: joint '{}' may only stand at {:.4g}, as ctrlrange says",
                            actuator.values.element().place(), excerpt(joint.name), low));
  if (joint.endless || low > joint.min || high < joint.max) narrowed_.push_back(joint.name);
  joint.min = low, joint.max = high, joint.endless = false;
  joint.motor.default_value = std::clamp(joint.motor.default_value, low, high);
}

/// The range of the target about its centre, times inheritrange.
void Drives::inherit_range(const MjcfDrive& drive, std::array<double, 2> target) {
  const double centre = 0.5 * (target[0] + target[1]),
               half = 0.5 * (target[1] - target[0]) * drive.actuator.inherit_range;
  control_ranges_[static_cast<size_t>(&drive - drives_.data())] = {centre - half, centre + half};
}

void Drives::take_control_ranges() {
  for (const MjcfDrive& drive : drives_)
    control_ranges_.push_back(drive.actuator.spec.control_range);
  for (const MjcfDrive& drive : drives_) {
    if (drive.actuator.inherit_range > 0) {
      const bool on_joint = !drive.tendon && !tree_.joints[drive.joint].endless;
      const bool on_tendon = drive.tendon && drive.tendon->values.has("range");
      if (drive.actuator.spec.control_range)
        warn(drive, "expected either ctrlrange or inheritrange, got both; ctrlrange is used");
      else if (on_joint)
        inherit_range(drive, {tree_.joints[drive.joint].min, tree_.joints[drive.joint].max});
      else if (on_tendon)
        inherit_range(drive, drive.tendon->values.range("range", document_.repairs()));
      else
        warn(drive, "inheritrange: expected a target with a range; not used");
    }
    if (!drive.tendon) take_control_range(drive);
  }
  if (!narrowed_.empty())
    cache_.note(fmt::format("{}: joints whose range ctrlrange narrows: {}", document_.file(),
                            some_names(narrowed_)));
}

// --- joints that share a tendon ---

/// Joints of one tendon move in proportion to their coefficients.
void Drives::tie(const MjcfDrive& drive) {
  const MjcfTendon& tendon = *drive.tendon;
  const XmlElement& at = drive.actuator.values.element();
  // joints that others tie may cancel out
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
    cache_.warn(
        fmt::format("{}: joints '{}' and '{}' share a tendon, '{}', and lose a DOF; they "
                    "are taken to turn as 1 to {:.4g}{}",
                    at.place(), excerpt(lead.name), excerpt(joint.name), excerpt(tendon.name),
                    ratio, narrowed));
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
  cache_.warn(fmt::format(
      "{}: actuators pull joints in different ratios; each of these joints stays a DOF "
      "with a motor of its own, and only robot.actuators has the tendons: joints {}; "
      "tendons {}",
      first->actuator.values.element().place(), some_names(joints), some_names(tendons)));
}

void Drives::tie_joints() {
  const size_t count = tree_.joints.size();
  // joints by the DOF that they would have without tendons
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

/// Gains of an actuator that pulls a DOF to where its control says, and damps it; those of several
/// add up.
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

void Drives::tell_powerless() const {
  std::vector<std::string> names;
  std::string place;
  for (const MjcfDrive& drive : drives_) {
    const ActuatorSpec& spec = drive.actuator.spec;
    if (drive.actuator.max_force() > 0) continue;
    if (names.empty()) place = drive.actuator.values.element().place();
    names.push_back(!spec.name.empty()    ? spec.name
                    : !spec.joint.empty() ? spec.joint
                                          : spec.tendon);
  }
  if (!names.empty())
    cache_.warn(
        fmt::format("{}: actuators that exert no force, for their gear, gain or range is "
                    "0, drive nothing: {}",
                    place, some_names(names)));
}

void Drives::set_motors() {
  tell_powerless();
  // largest force of the actuators of each joint, and of each tendon
  std::vector<double> efforts(tree_.joints.size(), 0);
  std::vector<bool> driven(tree_.joints.size(), false);
  std::vector<std::pair<const MjcfTendon*, double>> tensions;
  std::map<const MjcfTendon*, size_t> numbers;  // in tensions
  for (const MjcfDrive& drive : drives_) {
    check_stop();
    const double force = drive.actuator.max_force();
    if (drive.tendon) {
      const auto [found, is_new] = numbers.emplace(drive.tendon, tensions.size());
      if (is_new) tensions.emplace_back(drive.tendon, 0);
      tensions[found->second].second += force;
    } else {
      efforts[drive.joint] += force;
    }
    if (force > 0)
      for (const auto& [joint, pull] : pulls(drive)) driven[joint] = true;
    take_gains(drive);
  }
  const auto largest = [](const std::array<double, 2>& range) {
    return std::max(std::abs(range[0]), std::abs(range[1]));
  };
  for (auto& [tendon, force] : tensions) {
    if (tendon->force_range) force = std::min(force, largest(*tendon->force_range));
    if (force > 0)
      for (const auto& [joint, coefficient] : tendon->joints)
        efforts[joint] += force * std::abs(coefficient);
  }
  for (size_t j = 0; j < efforts.size(); ++j) {
    const auto& range = tree_.joints[j].force_range;
    if (!range) continue;
    efforts[j] = std::min(efforts[j], largest(*range));
    if ((*range)[0] != -(*range)[1])
      cache_.warn(fmt::format(
          "{}: joint '{}': actuatorfrcrange: expected -x x, got {} {}; the "
          "larger counts both ways",
          tree_.joints[j].place, excerpt(tree_.joints[j].name), (*range)[0], (*range)[1]));
    if (efforts[j] == 0) driven[j] = false;
  }
  for (TreeJoint& joint : tree_.joints) joint.motor.driven = false;
  std::map<int, double> by_dof;
  for (size_t j = 0; j < efforts.size(); ++j) {
    const TiedJoint tied = by_leader(tree_, static_cast<int>(j));
    // what stands still, or whose limit is 0, moves no leader
    if (!driven[j] || tied.leader < 0 || tied.ratio == 0 || efforts[j] == 0) continue;
    tree_.joints[tied.leader].motor.driven = true;
    by_dof[tied.leader] += efforts[j] * std::abs(tied.ratio);
  }
  for (const auto& [leader, effort] : by_dof)
    if (effort < no_bound) tree_.joints[leader].motor.max_effort = effort;
  for (size_t i = 0; i < drives_.size(); ++i) {
    const MjcfDrive& drive = drives_[i];
    tree_.actuators.push_back(drive.actuator.spec);
    tree_.actuators.back().control_range = control_ranges_[i];
    tree_.actuators.back().dof = drive.tendon ? drive.tendon->joints.front().first : drive.joint;
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
