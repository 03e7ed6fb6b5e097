#include "io/urdf_plan.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"
#include "io/tree_chains.h"

namespace clench {

namespace {

// a frame no further from an axis than this stands on it [m]
constexpr double on_axis = 1e-14;

class Planner {
 public:
  explicit Planner(const RobotSpec& robot) : robot_(robot) {}
  UrdfPlan plan();

 private:
  /// The link at the end of what stands so far, and our frame after the last joint in it.
  struct Tip {
    int link = 0;
    Pose X_LF;
  };

  /// Readers put the robot's name before it again.
  std::string body_name(const BodySpec& body) const;
  std::string unique(const std::string& name, std::set<std::string>& taken, bool given);
  int add_link(const std::string& name, const BodySpec* body);
  void choose_leaders();
  void plan_chain(int number);
  void hang_fixed(Tip& tip, const RobotPart& part);
  void hang_moved(Tip& tip, int chain, int joint, const RobotPart* part);
  UrdfJoint moving_joint(int chain, int joint) const;
  void set_limits(UrdfJoint& joint) const;
  void order_joints();

  const RobotSpec& robot_;
  UrdfPlan plan_;
  std::vector<const JointSpec*> leaders_;  // by DOF
  std::set<std::string> link_names_, joint_names_;
};

/// Rz(theta) Tz(d) Tx(a) Rx(alpha)
Pose dh_pose(double theta, double d, double a, double alpha) {
  return Pose::turn(theta, Eigen::Vector3d::UnitZ()) * Pose::translation({a, 0, d}) *
         Pose::turn(alpha, Eigen::Vector3d::UnitX());
}

/// A name that readers take as it stands: XML trims it, and xacro would look into it.
std::string cleaned(const std::string& name) {
  std::string out(trim(name));
  for (size_t i = 0; i < out.size(); ++i) {
    if (static_cast<unsigned char>(out[i]) < ' ') out[i] = '_';
    if (out[i] == '$' && i + 1 < out.size() && (out[i + 1] == '{' || out[i + 1] == '('))
      out[i] = '_';
  }
  return out.empty() ? "unnamed" : out;
}

std::string Planner::body_name(const BodySpec& body) const {
  const std::string prefix = robot_.name + "_";
  return body.name.starts_with(prefix) ? body.name.substr(prefix.size()) : body.name;
}

std::string Planner::unique(const std::string& name, std::set<std::string>& taken, bool given) {
  const std::string clean = cleaned(name);
  std::string out = clean;
  for (int i = 2; !taken.insert(out).second; ++i) out = fmt::format("{}_{}", clean, i);
  if (given && out != name)
    plan_.renamed.push_back(fmt::format("{} is called {} in it", in_quotes(name), in_quotes(out)));
  return out;
}

int Planner::add_link(const std::string& name, const BodySpec* body) {
  plan_.links.push_back({unique(name, link_names_, body != nullptr), body, {}});
  return static_cast<int>(plan_.links.size()) - 1;
}

/// The joint whose value is nearest to the DOF's: its own, its opposite, or the first one.
void Planner::choose_leaders() {
  leaders_.assign(robot_.dofs.size(), nullptr);
  for (const double expected : {1.0, -1.0, 0.0})
    for (const ChainSpec& chain : robot_.chains)
      for (const JointSpec& joint : chain.joints)
        if (!leaders_[joint.dof] && (joint.ratio == expected || expected == 0))
          leaders_[joint.dof] = &joint;
  plan_.leader_of.assign(robot_.dofs.size(), -1);
}

// --- joints ---

/// Does a joint leave the one that leads it so little of its range that readers take it for a slip?
bool stops(const JointSpec& joint, const JointSpec& leader) {
  const double a = joint.min / joint.ratio, b = joint.max / joint.ratio;
  const double c = leader.min / leader.ratio, d = leader.max / leader.ratio;
  const double left =
      std::min(std::max(a, b), std::max(c, d)) - std::max(std::min(a, b), std::min(c, d));
  return left < 1.01 * min_follower_range * std::abs(d - c);
}

void Planner::set_limits(UrdfJoint& joint) const {
  const JointSpec& spec = *joint.spec;
  double low = spec.min, high = spec.max;
  if (joint.leads && std::ranges::any_of(robot_.chains, [&](const ChainSpec& chain) {
        return std::ranges::any_of(chain.joints, [&](const JointSpec& other) {
          return other.dof == spec.dof && stops(other, spec);
        });
      })) {
    const auto range = dof_range(robot_, spec.dof);
    low = std::min(range[0] * spec.ratio, range[1] * spec.ratio);
    high = std::max(range[0] * spec.ratio, range[1] * spec.ratio);
  }
  const bool turned = joint.leads && spec.ratio < 0;  // its axis is
  joint.min = (turned ? -high : low) + joint.offset;
  joint.max = (turned ? -low : high) + joint.offset;
}

/// With everything but its place in the tree.
UrdfJoint Planner::moving_joint(int chain, int number) const {
  const JointSpec& spec = robot_.chains[chain].joints[number];
  const double leader = leaders_[spec.dof]->ratio;
  UrdfJoint joint;
  joint.spec = &spec;
  joint.leads = leaders_[spec.dof] == &spec;
  joint.factor = joint.leads ? std::abs(leader) : spec.ratio;
  // joints of DOFs of their own have no offset; followers of today's files have theirs
  if (!joint.leads && spec.placed_freely)
    joint.offset = spec.kind == JointKind::revolute ? spec.theta : spec.d;
  set_limits(joint);
  joint.name = !spec.name.empty() ? spec.name
               : joint.leads && !robot_.dofs[spec.dof].name.empty()
                   ? robot_.dofs[spec.dof].name
                   : fmt::format("chain{}_joint{}", chain, number);
  return joint;
}

/// A link of ours, or without one a frame, moved by a joint.
void Planner::hang_moved(Tip& tip, int chain, int number, const RobotPart* part) {
  const JointSpec& spec = robot_.chains[chain].joints[number];
  const LinkSpec* link = part ? &robot_.chains[chain].links[part->link] : nullptr;
  UrdfJoint joint = moving_joint(chain, number);
  const bool revolute = spec.kind == JointKind::revolute;
  const Pose zero = dh_pose(spec.theta - (revolute ? joint.offset : 0),
                            spec.d - (revolute ? 0 : joint.offset), 0, 0);
  // to our frame after the joint, and on to that of the link
  const Pose after = dh_pose(0, 0, spec.a, spec.alpha) * spec.X_after;
  const Pose to_link = link && link->X_JL ? after * *link->X_JL : after;
  const bool fits = !revolute || std::hypot(to_link.position.x(), to_link.position.y()) <= on_axis;
  joint.parent = tip.link;
  joint.X_PC = tip.X_LF * spec.X_before * zero;
  if (fits) {
    joint.X_PC = joint.X_PC * to_link;
    joint.axis = to_link.rotation.conjugate() * joint.axis;
  }
  if (joint.leads && spec.ratio < 0) joint.axis = -joint.axis;
  joint.child = link ? add_link(body_name(link->body), &link->body)
                     : add_link(joint.name + "_frame", nullptr);
  plan_.links[joint.child].X_UB = fits ? Pose{} : to_link;
  joint.name = unique(joint.name, joint_names_, !spec.name.empty());
  plan_.joints.push_back(joint);
  tip = {joint.child, !fits ? after : link && link->X_JL ? link->X_JL->inverse() : Pose{}};
  if (part) plan_.link_of[chain][part->link] = joint.child;
}

void Planner::hang_fixed(Tip& tip, const RobotPart& part) {
  const LinkSpec& link = robot_.chains[part.chain].links[part.link];
  UrdfJoint joint;
  joint.parent = tip.link;
  joint.child = add_link(body_name(link.body), &link.body);
  joint.X_PC = link.X_JL ? tip.X_LF * *link.X_JL : tip.X_LF;
  joint.name = unique(plan_.links[joint.child].name + "_fixed", joint_names_, false);
  plan_.joints.push_back(joint);
  tip = {joint.child, link.X_JL ? link.X_JL->inverse() : Pose{}};
  plan_.link_of[part.chain][part.link] = joint.child;
}

// --- chains ---

void Planner::plan_chain(int number) {
  const ChainSpec& chain = robot_.chains[number];
  Tip tip;
  tip.link = plan_.link({chain.parent_chain, chain.parent_link});
  const Pose& X_UB = plan_.links[tip.link].X_UB;
  tip.X_LF = X_UB == Pose{} ? chain.X_BC : X_UB * chain.X_BC;
  plan_.link_of.emplace_back(chain.links.size(), 0);
  for (int j = -1; j < static_cast<int>(chain.joints.size()); ++j) {
    bool moved = j < 0;
    for (int l = 0; l < static_cast<int>(chain.links.size()); ++l) {
      if (chain.links[l].last_joint != j) continue;
      const RobotPart part{number, l};
      if (moved)
        hang_fixed(tip, part);
      else
        hang_moved(tip, number, j, &part);
      moved = true;
    }
    if (!moved) hang_moved(tip, number, j, nullptr);
  }
}

/// Readers number DOFs as their joints come, and chains too: joints come chain by chain, but for
/// leaders, which come as their DOFs do.
void Planner::order_joints() {
  std::vector<int> of_dof(robot_.dofs.size(), -1), order;
  const int count = static_cast<int>(plan_.joints.size());
  for (int j = 0; j < count; ++j)
    if (plan_.joints[j].leads) of_dof[plan_.joints[j].spec->dof] = j;
  int next = 0;
  const auto followers_up_to = [&](int end) {
    for (; next < end; ++next)
      if (!plan_.joints[next].leads) order.push_back(next);
  };
  for (const int leader : of_dof) {
    if (leader < 0) continue;
    followers_up_to(leader);
    order.push_back(leader);
  }
  followers_up_to(count);
  std::vector<UrdfJoint> joints;
  for (const int j : order) joints.push_back(plan_.joints[j]);
  plan_.joints = std::move(joints);
  for (int j = 0; j < count; ++j)
    if (plan_.joints[j].leads) plan_.leader_of[plan_.joints[j].spec->dof] = j;
}

UrdfPlan Planner::plan() {
  plan_.name = robot_.name.empty() ? "" : cleaned(robot_.name);
  choose_leaders();
  add_link(body_name(robot_.base), &robot_.base);
  for (int c = 0; c < static_cast<int>(robot_.chains.size()); ++c) plan_chain(c);
  order_joints();
  return std::move(plan_);
}

}  // namespace

UrdfPlan plan_urdf(const RobotSpec& robot) { return Planner(robot).plan(); }

}  // namespace clench
