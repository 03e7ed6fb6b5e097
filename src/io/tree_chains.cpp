#include "io/tree_chains.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text.h"
#include "io/closing_choice.h"
#include "io/closing_guess.h"
#include "io/repair_names.h"
#include "math/decompositions.h"

namespace clench {

namespace {

/// Turns z to the axis: about their common normal.
Pose axis_frame(const Eigen::Vector3d& axis) {
  if (axis == Eigen::Vector3d::UnitZ()) return {};
  return Pose::turn(shortest_rotation(Eigen::Vector3d::UnitZ(), axis).normalized());
}

class ChainMaker {
 public:
  ChainMaker(TreeModel tree, const std::string& file, const Library& library)
      : tree_(std::move(tree)), file_(file), library_(library) {}
  RobotSpec make();

 private:
  void number_dofs();
  void widen_followers();
  void choose_ways();
  void add_link(int link);
  JointSpec joint_spec(const TreeJoint& joint, const Pose& before) const;
  LinkSpec link_spec(int link) const;
  void close_hand();
  void tell_closing(const ClosingGuess& guess);
  RobotPart part(int link) const { return parts_[link]; }

  TreeModel tree_;
  const std::string& file_;
  const Library& library_;
  RobotSpec robot_;
  std::vector<int> dof_of_;  // one per joint: of the leader; -1 for followers and what never moves
  std::vector<int> way_on_;  // one per link: the child that goes on in its chain; -1: none
  std::vector<RobotPart> parts_;  // one per link
  std::vector<Pose>
      pending_;  // one per chain: from the frame after its last joint to its last link
};

void ChainMaker::number_dofs() {
  for (const TreeJoint& joint : tree_.joints) {
    dof_of_.push_back(joint.leader < 0 ? static_cast<int>(robot_.dofs.size()) : -1);
    if (joint.leader >= 0) continue;
    DofSpec dof;
    dof.name = joint.name;
    dof.max_effort = joint.effort;
    dof.max_velocity = joint.velocity;
    dof.kp = joint.kp;
    dof.kd = joint.kd;
    dof.default_value = joint.start;
    robot_.dofs.push_back(dof);
  }
}

// limits beyond this are those of nobody [rad or m]
constexpr double unlimited = 1e6;

std::string way_text(double low, double high) {
  return low <= -unlimited && high >= unlimited ? "without limits"
                                                : fmt::format("from {:.6g} to {:.6g}", low, high);
}

std::string limits_text(double low, double high) {
  return low <= -unlimited && high >= unlimited ? "(unlimited)"
                                                : fmt::format("[{:.6g}, {:.6g}]", low, high);
}

void ChainMaker::widen_followers() {
  std::map<int, std::pair<double, double>> ranges;  // by leader: what its followers leave
  for (TreeJoint& joint : tree_.joints) {
    if (joint.leader < 0 || joint.ratio == 0) continue;
    const TreeJoint& leader = tree_.joints[joint.leader];
    const double a = joint.ratio * leader.min + joint.offset,
                 b = joint.ratio * leader.max + joint.offset;
    const double low = std::min(a, b), high = std::max(a, b);
    const double left = std::min(high, joint.max) - std::max(low, joint.min);
    // what its limits leave of the leader's range, counted as dof_range does
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
    library_.warn(
        slips ? fmt::format("{}: joint '{}' follows '{}' {}, and its own limits {} would stop "
                            "that; they are not used",
                            joint.place, excerpt(joint.name), excerpt(leader.name),
                            way_text(low, high), limits_text(joint.min, joint.max))
              : fmt::format("{}: joint '{}' follows '{}', and its own limits {} have no value in "
                            "common with those of others that follow it; they are not used",
                            joint.place, excerpt(joint.name), excerpt(leader.name),
                            limits_text(joint.min, joint.max)));
    // a leader that stands still must not be moved by rounding
    const double slack = high - low < 1e-9 ? 1e-9 * std::max(1.0, std::abs(low)) : 0;
    joint.min = low - slack;
    joint.max = high + slack;
  }
}

/// Which child goes on in its parent's chain: the one that leads on to joints, if there is just
/// one; of children that are all fixed to the end the first.
void ChainMaker::choose_ways() {
  const int count = static_cast<int>(tree_.links.size());
  std::vector<bool> moves(count);  // is there a joint in the link or beyond it?
  for (int i = count - 1; i > 0; --i) {
    moves[i] = moves[i] || !tree_.links[i].joints.empty();
    if (moves[i]) moves[tree_.links[i].parent] = true;
  }
  std::vector<int> moving(count), first(count, -1), first_moving(count, -1);
  for (int i = 1; i < count; ++i) {
    const int parent = tree_.links[i].parent;
    if (first[parent] < 0) first[parent] = i;
    if (!moves[i]) continue;
    ++moving[parent];
    if (first_moving[parent] < 0) first_moving[parent] = i;
  }
  way_on_.assign(count, -1);
  for (int i = 1; i < count; ++i)
    way_on_[i] = moving[i] == 1 ? first_moving[i] : moving[i] == 0 ? first[i] : -1;
}

JointSpec ChainMaker::joint_spec(const TreeJoint& joint, const Pose& before) const {
  const int leader =
      joint.leader < 0 ? static_cast<int>(&joint - tree_.joints.data()) : joint.leader;
  const double offset = joint.leader < 0 ? 0 : joint.offset;
  const Pose A = axis_frame(joint.axis);
  JointSpec spec;
  spec.name = joint.name;
  spec.kind = joint.kind;
  spec.dof = dof_of_[leader];
  spec.ratio = joint.leader < 0 ? 1 : joint.ratio;
  // the constant part of q is that of theta or d, and is no part of the limits
  (joint.kind == JointKind::revolute ? spec.theta : spec.d) = offset - joint.zero;
  spec.min = joint.min - offset;
  spec.max = joint.max - offset;
  const Pose anchor = Pose::translation(joint.anchor);
  spec.placed_freely = true;
  spec.X_before = before * anchor * A;
  spec.X_after = A.inverse() * Pose::translation(-joint.anchor);
  spec.viscous = joint.viscous;
  spec.coulomb = joint.coulomb;
  spec.spring = joint.spring;
  spec.rest = joint.rest - offset;
  return spec;
}

LinkSpec ChainMaker::link_spec(int link) const {
  LinkSpec spec;
  spec.body = tree_.links[link].body;
  spec.body.name = robot_.name + "_" + spec.body.name;
  const auto& joints = tree_.links[link].joints;
  spec.joint = joints.empty()                                              ? LinkJoint::fixed
               : joints.size() == 2                                        ? LinkJoint::universal
               : joints.size() == 3                                        ? LinkJoint::ball
               : tree_.joints[joints.front()].kind == JointKind::prismatic ? LinkJoint::prismatic
                                                                           : LinkJoint::revolute;
  return spec;
}

void ChainMaker::add_link(int link) {
  const TreeLink& from = tree_.links[link];
  const RobotPart parent = part(from.parent);
  Pose at;  // from the frame after the chain's last joint
  int c = parent.chain;
  if (from.parent == 0 || way_on_[from.parent] != link) {
    c = static_cast<int>(robot_.chains.size());
    ChainSpec chain;
    chain.parent_chain = parent.chain;
    chain.parent_link = parent.link;
    chain.X_BC = from.X_PL;
    robot_.chains.push_back(std::move(chain));
    pending_.emplace_back();
  } else {
    at = pending_[c] * from.X_PL;
  }
  ChainSpec& chain = robot_.chains[c];
  for (const int j : from.joints) {
    const TreeJoint& joint = tree_.joints[j];
    if (joint.leader >= 0 && joint.ratio == 0) {  // a follower that does not follow
      at = at * joint_pose(joint, joint.offset);
      continue;
    }
    chain.joints.push_back(joint_spec(joint, at));
    at = Pose{};
  }
  LinkSpec spec = link_spec(link);
  spec.last_joint = static_cast<int>(chain.joints.size()) - 1;
  if (!(at == Pose{})) spec.X_JL = at;
  pending_[c] = at;
  parts_[link] = {c, static_cast<int>(chain.links.size())};
  chain.links.push_back(std::move(spec));
}

void ChainMaker::tell_closing(const ClosingGuess& guess) {
  std::vector<std::string> closing;
  for (const DofSpec& dof : robot_.dofs)
    if (dof.default_velocity != 0)
      closing.push_back((dof.default_velocity > 0 ? "+" : "-") + dof.name);
  library_.note(
      !closing.empty()
          ? fmt::format("{}: these DOFs close it, by its geometry: {}; the option "
                        "'close' says otherwise",
                        file_, name_list(closing))
          : fmt::format("{}: no DOF is found to close it; the option 'close' names some", file_));
  if (!guess.X_BA || library_.options().approach) return;
  const Eigen::Vector3d z = guess.X_BA->rotation * Eigen::Vector3d::UnitZ();
  library_.note(
      fmt::format("{}: it approaches along ({:.3g}, {:.3g}, {:.3g}) of its base, by its "
                  "geometry; the option 'approach' says otherwise",
                  file_, z.x() + 0.0, z.y() + 0.0, z.z() + 0.0));
}

void ChainMaker::close_hand() {
  const ClosingGuess guess = guess_closing(tree_);
  for (size_t j = 0; j < tree_.joints.size(); ++j)
    if (dof_of_[j] >= 0) set_closing(robot_, dof_of_[j], guess.senses[j]);
  robot_.X_BA = guess.X_BA;
  choose_closing(robot_, file_, library_.options());
  tell_closing(guess);
}

RobotSpec ChainMaker::make() {
  resolve_leaders(tree_);
  order_branches(tree_);
  robot_.name = tree_.name;
  robot_.class_name = tree_.class_name;
  robot_.chain_links_collide = true;
  robot_.base = tree_.links.front().body;
  robot_.base.name = robot_.name + "_" + robot_.base.name;
  number_dofs();
  widen_followers();
  choose_ways();
  parts_.resize(tree_.links.size());
  for (int i = 1; i < static_cast<int>(tree_.links.size()); ++i) add_link(i);
  for (const auto& [a, b] : tree_.never_meet)
    robot_.collision_rules.pairs_off.push_back({part(a), part(b)});
  close_hand();
  check_read_robot(robot_, file_, library_.options());
  return std::move(robot_);
}

}  // namespace

RobotSpec make_chains(TreeModel tree, const std::string& file, const Library& library) {
  return ChainMaker(std::move(tree), file, library).make();
}

}  // namespace clench
