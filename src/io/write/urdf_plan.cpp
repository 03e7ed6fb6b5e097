#include "clench/io/write/urdf_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "clench/base/text.h"
#include "clench/io/tree/tree_model.h"
#include "clench/io/tree/tree_robot.h"

namespace clench {

namespace {

// largest distance of a frame from an axis on which it counts as lying [m]
constexpr double on_axis = 1e-14;

class Planner {
 public:
  explicit Planner(const RobotSpec& robot) : robot_(robot) {}
  UrdfPlan plan();

 private:
  /// The name without the robot's name, which readers prepend again.
  std::string body_name(const BodySpec& body) const;
  std::string unique(const std::string& name, std::set<std::string>& taken, bool given);
  int add_link(const std::string& name, const BodySpec* body);
  void choose_leaders();
  void add_link_with_joints(int number);
  int hang_fixed(int parent, const Pose& X_PC, const BodySpec& body);
  int hang_moved(int parent, const Pose& X_PJ, const JointSpec& spec, const LinkSpec* link);
  UrdfJoint moving_joint(const JointSpec& spec) const;
  void set_limits(UrdfJoint& joint) const;
  void order_joints();

  const RobotSpec& robot_;
  UrdfPlan plan_;
  std::vector<const JointSpec*> leaders_;                // by DOF
  std::map<const JointSpec*, std::string> usual_names_;  // by chain and number
  std::set<std::string> link_names_, joint_names_;
};

/// A name that readers do not change: XML trims blanks, and xacro would expand ${...} and $(...).
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

/// Selects the joint that represents each DOF: one with the same value, otherwise the opposite
/// value, otherwise the first.
void Planner::choose_leaders() {
  leaders_.assign(robot_.dofs.size(), nullptr);
  for (const double expected : {1.0, -1.0, 0.0})
    each_joint(robot_, [&](const JointSpec& joint) {
      if (!leaders_[joint.dof] && (joint.ratio == expected || expected == 0))
        leaders_[joint.dof] = &joint;
    });
  plan_.leader_of.assign(robot_.dofs.size(), -1);
}

// --- joints ---

/// True if a joint limits the leader's range so strongly that readers treat these limits as a
/// mistake.
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
  bool stopped = false;
  each_joint(robot_, [&](const JointSpec& other) {
    stopped = stopped || (joint.leads && other.dof == spec.dof && stops(other, spec));
  });
  if (stopped) {
    const auto range = dof_range(robot_, spec.dof);
    low = std::min(range[0] * spec.ratio, range[1] * spec.ratio);
    high = std::max(range[0] * spec.ratio, range[1] * spec.ratio);
  }
  const bool turned = joint.leads && spec.ratio < 0;  // the axis is reversed then
  joint.min = turned ? -high : low;
  joint.max = turned ? -low : high;
  // for a slide the limits express it
  joint.endless = spec.endless && !stopped;
  if (joint.endless && spec.kind == JointKind::prismatic)
    joint.min = -unlimited, joint.max = unlimited;
}

/// A joint with everything except its parent and child.
UrdfJoint Planner::moving_joint(const JointSpec& spec) const {
  const double leader = leaders_[spec.dof]->ratio;
  UrdfJoint joint;
  joint.spec = &spec;
  joint.leads = leaders_[spec.dof] == &spec;
  joint.factor = joint.leads ? std::abs(leader) : spec.ratio;
  set_limits(joint);
  joint.name = !spec.name.empty()                                   ? spec.name
               : joint.leads && !robot_.dofs[spec.dof].name.empty() ? robot_.dofs[spec.dof].name
                                                                    : usual_names_.at(&spec);
  return joint;
}

/// Adds a link of the robot, or a frame if null, moved by a joint.   returns  its number
int Planner::hang_moved(int parent, const Pose& X_PJ, const JointSpec& spec, const LinkSpec* link) {
  UrdfJoint joint = moving_joint(spec);
  const Pose to_link = link ? link->X_JL : Pose{};
  const Eigen::Vector3d off = to_link.position - to_link.position.dot(spec.axis) * spec.axis;
  const bool fits = spec.kind == JointKind::prismatic || off.norm() <= on_axis;
  joint.parent = parent;
  joint.X_PC = X_PJ;
  joint.axis = spec.axis;
  if (fits && !(to_link == Pose{})) {
    joint.X_PC = joint.X_PC * to_link;
    joint.axis = to_link.rotation.conjugate() * joint.axis;
  }
  if (joint.leads && spec.ratio < 0) joint.axis = -joint.axis;
  joint.child = link ? add_link(body_name(link->body), &link->body)
                     : add_link(joint.name + "_frame", nullptr);
  plan_.links[joint.child].X_UB = fits ? Pose{} : to_link;
  joint.name = unique(joint.name, joint_names_, !spec.name.empty());
  plan_.joints.push_back(joint);
  return joint.child;
}

int Planner::hang_fixed(int parent, const Pose& X_PC, const BodySpec& body) {
  UrdfJoint joint;
  joint.parent = parent;
  joint.child = add_link(body_name(body), &body);
  joint.X_PC = X_PC;
  joint.name = unique(plan_.links[joint.child].name + "_fixed", joint_names_, false);
  plan_.joints.push_back(joint);
  return joint.child;
}

static Pose product(const Pose& a, const Pose& b) {
  return a == Pose{} ? b : b == Pose{} ? a : a * b;
}

void Planner::add_link_with_joints(int number) {
  const LinkSpec& link = robot_.links[number];
  int at = plan_.link(link.parent);
  Pose X = plan_.links[at].X_UB;  // of the robot's frame there
  for (const JointSpec& joint : link.joints) {
    at = hang_moved(at, product(X, joint.X_PJ), joint,
                    &joint == &link.joints.back() ? &link : nullptr);
    X = Pose{};
  }
  if (link.joints.empty()) at = hang_fixed(at, product(X, link.X_JL), link.body);
  plan_.link_of[number] = at;
}

/// Readers number DOFs and chains in the order of the joints: joints are sorted by chain, except
/// for leaders, which have the order of their DOFs.
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
  plan_.link_of.resize(robot_.links.size());
  const auto chains = chains_of(robot_);
  for (size_t c = 0; c < chains.size(); ++c) {
    int count = 0;
    for (const int link : chains[c].links)
      for (const JointSpec& joint : robot_.links[link].joints)
        usual_names_[&joint] = fmt::format("chain{}_joint{}", c, count++);
  }
  for (const Chain& chain : chains)
    for (const int link : chain.links) add_link_with_joints(link);
  order_joints();
  return std::move(plan_);
}

}  // namespace

// from the root, each link after its parent, branches in the order of their joints
static TreeModel tree_of(const UrdfPlan& plan) {
  std::vector<std::vector<int>> below(plan.links.size());
  for (int j = 0; j < static_cast<int>(plan.joints.size()); ++j)
    below[plan.joints[j].parent].push_back(j);
  TreeModel tree;
  struct Step {
    int link, parent, joint;
  };
  std::vector<Step> stack = {{0, -1, -1}};
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    const int number = static_cast<int>(tree.links.size());
    TreeLink& link = tree.links.emplace_back();
    link.body.name = plan.links[step.link].name;
    link.parent = step.parent;
    if (step.joint >= 0 && plan.joints[step.joint].spec) link.joints.push_back(step.joint);
    for (auto it = below[step.link].rbegin(); it != below[step.link].rend(); ++it)
      stack.push_back({plan.joints[*it].child, number, *it});
  }
  for (const UrdfJoint& joint : plan.joints) {
    TreeJoint& out = tree.joints.emplace_back();
    if (!joint.spec) continue;
    out.kind = joint.spec->kind;
    out.ratio = joint.factor;
    out.leader = joint.leads ? -1 : plan.leader_of[joint.spec->dof];
  }
  return tree;
}

RobotSpec outline_of(const UrdfPlan& plan) {
  TreeModel tree = tree_of(plan);
  order_branches(tree);
  RobotSpec out;
  out.base.name = tree.links.front().body.name;
  for (size_t l = 1; l < tree.links.size(); ++l) {
    LinkSpec& link = out.links.emplace_back();
    link.body.name = tree.links[l].body.name;
    link.parent = tree.links[l].parent - 1;  // the root is the base
    for (const int j : tree.links[l].joints) link.joints.emplace_back(tree.joints[j]);
  }
  order_by_chains(out);
  return out;
}

UrdfPlan plan_urdf(const RobotSpec& robot) { return Planner(robot).plan(); }

}  // namespace clench
