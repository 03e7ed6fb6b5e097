#include "clench/io/tree/tree_robot.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "clench/base/text.h"
#include "clench/io/text/repair_names.h"
#include "clench/io/tree/closing_choice.h"
#include "clench/spec/approach_guess.h"
#include "clench/spec/chains.h"
#include "clench/spec/closing_guess.h"
#include "clench/spec/dof_drive.h"

namespace clench {

namespace {

class RobotMaker {
 public:
  RobotMaker(TreeModel tree, const std::string& file, const FileCache& cache,
             const std::function<bool(RobotSpec&)>& known)
      : tree_(std::move(tree)), file_(file), cache_(cache), known_(known) {}
  RobotSpec make();

 private:
  void number_dofs();
  void widen_followers();
  void add_link(const TreeLink& from);
  JointSpec joint_spec(const TreeJoint& joint, const Pose& before) const;
  void settle_motors();
  void close_hand();
  void tell_closing();
  void tell_approach();

  TreeModel tree_;
  const std::string& file_;
  const FileCache& cache_;
  const std::function<bool(RobotSpec&)>& known_;
  RobotSpec robot_;
  std::vector<int> dof_of_;    // DOF per joint, for leaders; -1 for followers
  std::vector<bool> passive_;  // one per DOF: true if no motor closes it
};

void RobotMaker::number_dofs() {
  for (const TreeJoint& joint : tree_.joints) {
    dof_of_.push_back(joint.leader < 0 ? static_cast<int>(robot_.dofs.size()) : -1);
    if (joint.leader >= 0) continue;
    robot_.dofs.push_back(joint.motor);
    robot_.dofs.back().name = joint.name;
  }
}

std::string limits_text(double low, double high) {
  return fmt::format("[{:.6g}, {:.6g}]", low, high);
}

void RobotMaker::widen_followers() {
  std::map<int, std::pair<double, double>> ranges;  // by leader: range left by its followers
  for (TreeJoint& joint : tree_.joints) {
    if (joint.leader < 0 || joint.ratio == 0) continue;
    const TreeJoint& leader = tree_.joints[joint.leader];
    const double a = joint.ratio * leader.min + joint.offset,
                 b = joint.ratio * leader.max + joint.offset;
    const double low = std::min(a, b), high = std::max(a, b);
    if (joint.endless) {
      joint.min = low, joint.max = high;
      continue;
    }
    const double left = std::min(high, joint.max) - std::max(low, joint.min);
    // part of the leader's range left by these limits, computed as in dof_range
    const double c = (joint.min - joint.offset) / joint.ratio,
                 d = (joint.max - joint.offset) / joint.ratio;
    auto& range = ranges.try_emplace(joint.leader, leader.min, leader.max).first->second;
    const std::pair<double, double> narrower(std::max(range.first, std::min(c, d)),
                                             std::min(range.second, std::max(c, d)));
    const bool slips = left < min_follower_range * (high - low);
    if (!slips && narrower.first <= narrower.second) {
      range = narrower;
      continue;
    }
    cache_.diagnostics().warn(
        slips ? fmt::format("{}: joint '{}' follows '{}' from {:.6g} to {:.6g}, and its own limits "
                            "{} would stop "
                            "that; they are not used",
                            joint.place, excerpt(joint.name), excerpt(leader.name), low, high,
                            limits_text(joint.min, joint.max))
              : fmt::format("{}: joint '{}' follows '{}', and its own limits {} have no value in "
                            "common with those of others that follow it; they are not used",
                            joint.place, excerpt(joint.name), excerpt(leader.name),
                            limits_text(joint.min, joint.max)));
    // rounding must not move a leader whose range is a point
    const double slack = high - low < 1e-9 ? 1e-9 * std::max(1.0, std::abs(low)) : 0;
    joint.min = low - slack;
    joint.max = high + slack;
    joint.endless = leader.endless;
  }
}

JointSpec RobotMaker::joint_spec(const TreeJoint& joint, const Pose& before) const {
  const int leader =
      joint.leader < 0 ? static_cast<int>(&joint - tree_.joints.data()) : joint.leader;
  JointSpec spec = joint;
  spec.dof = dof_of_[leader];
  spec.X_PJ = before;
  if (!joint.anchor.isZero(0)) spec.X_PJ = spec.X_PJ * Pose::translation(joint.anchor);
  // the constant part of q goes into the frame, and is subtracted from the limits
  if (joint.offset != joint.zero)
    spec.X_PJ = spec.X_PJ * joint_motion(spec, joint.offset - joint.zero);
  for (double* q : {&spec.min, &spec.max, &spec.rest}) *q -= joint.offset;
  return spec;
}

void RobotMaker::add_link(const TreeLink& from) {
  LinkSpec link;
  link.body = from.body;
  link.body.name = robot_.name + "_" + link.body.name;
  link.parent = from.parent - 1;  // the root is the base
  Pose at = from.X_PL;
  for (const int j : from.joints) {
    const TreeJoint& joint = tree_.joints[j];
    if (joint.leader >= 0 && joint.ratio == 0) {  // a follower with ratio 0 is fixed
      at = at * joint_pose(joint, joint.offset);
      continue;
    }
    link.joints.push_back(joint_spec(joint, at));
    at = Pose::translation(-joint.anchor);
  }
  link.X_JL = at;
  robot_.links.push_back(std::move(link));
}

void RobotMaker::tell_closing() {
  std::vector<std::string> closing;
  for (const DofSpec& dof : robot_.dofs)
    if (dof.default_velocity != 0)
      closing.push_back((dof.default_velocity > 0 ? "+" : "-") + dof.name);
  cache_.diagnostics().note(
      !closing.empty()
          ? fmt::format(
                "{}: these DOFs close it, by its geometry: {}; the option 'close' overrides this",
                file_, name_list(closing))
          : fmt::format("{}: no DOF is found to close it; the option 'close' names some", file_));
  tell_approach();
}

void RobotMaker::tell_approach() {
  if (!robot_.X_BA || cache_.options().approach) return;
  const Eigen::Vector3d z = robot_.X_BA->rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d& p = robot_.X_BA->position;
  cache_.diagnostics().note(
      Place(file_),
      "by its geometry its approach direction is ({:.3g}, {:.3g}, {:.3g}) and its approach point "
      "({:.3f}, {:.3f}, {:.3f}) m in its base; the option 'approach' overrides this",
      z.x() + 0.0, z.y() + 0.0, z.z() + 0.0, p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
}

/// Determines from the actuators which DOFs they drive, and their maximum efforts. If the file has
/// no actuators, any joint may close.
void RobotMaker::settle_motors() {
  passive_.assign(robot_.dofs.size(), false);
  if (!tree_.has_actuators) return;
  std::vector<std::string> names;
  for (int d = 0; d < static_cast<int>(robot_.dofs.size()); ++d) {
    DofSpec& dof = robot_.dofs[d];
    const DofDrive drive = drive_of(robot_, d);
    dof.driven = dof.driven && drive.acts();
    passive_[d] = !dof.driven;
    if (!dof.driven) names.push_back(fmt::format("'{}'", excerpt(dof.name)));
    const EffortRange limits = drive.limits();
    const double most = std::max(-limits.low, limits.high);
    if (dof.driven && std::isfinite(most)) dof.max_effort = most;
  }
  if (names.empty()) return;
  constexpr size_t shown = 6;
  const bool more = names.size() > shown;
  names.resize(std::min(names.size(), shown));
  cache_.diagnostics().note(Place(file_), "joints that no actuator drives do not close: {}{}",
                            fmt::join(names, ", "), more ? " and others" : "");
}

void RobotMaker::close_hand() {
  if (known_ && known_(robot_)) {
    choose_closing(robot_, file_, cache_.options());
    if (robot_.X_BA) return;
    robot_.X_BA = guess_approach(robot_);
    tell_approach();
    return;
  }
  const auto senses = guess_closing(robot_, passive_);
  for (size_t d = 0; d < senses.size(); ++d) set_closing(robot_, static_cast<int>(d), senses[d]);
  choose_closing(robot_, file_, cache_.options());
  slow_distal_joints(robot_);
  if (!robot_.X_BA) robot_.X_BA = guess_approach(robot_);
  tell_closing();
}

RobotSpec RobotMaker::make() {
  resolve_leaders(tree_);
  order_branches(tree_);
  robot_.name = tree_.name;
  robot_.class_name = tree_.class_name;
  robot_.chain_links_collide = true;
  robot_.base = tree_.links.front().body;
  robot_.base.name = robot_.name + "_" + robot_.base.name;
  number_dofs();
  widen_followers();
  for (size_t i = 1; i < tree_.links.size(); ++i) add_link(tree_.links[i]);
  const auto now = order_by_chains(robot_);
  const auto part = [&](int link) { return link == 0 ? -1 : now[link - 1]; };
  for (const auto& [a, b] : tree_.never_meet)
    robot_.collision_rules.pairs_off.push_back({part(a), part(b)});
  for (const auto& [a, b] : tree_.always_meet)
    robot_.collision_rules.pairs_on.push_back({part(a), part(b)});
  for (JointTendonSpec tendon : tree_.tendons) {
    for (auto& [joint, arm] : tendon.arms) joint = dof_of_[joint];
    robot_.joint_tendons.push_back(std::move(tendon));
  }
  for (ActuatorSpec actuator : tree_.actuators) {
    if (const int joint = actuator.dof; joint >= 0)
      actuator.dof = dof_of_[tree_.joints[joint].leader < 0 ? joint : tree_.joints[joint].leader];
    robot_.actuators.push_back(std::move(actuator));
  }
  settle_motors();
  close_hand();
  check_read_robot(robot_, Place(file_), cache_.options());
  return std::move(robot_);
}

}  // namespace

RobotSpec make_robot(TreeModel tree, const std::string& file, const FileCache& cache,
                     const std::function<bool(RobotSpec&)>& known) {
  return RobotMaker(std::move(tree), file, cache, known).make();
}

}  // namespace clench
