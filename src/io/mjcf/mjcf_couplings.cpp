#include "clench/io/mjcf/mjcf_couplings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "clench/base/suggest.h"

namespace clench {

namespace {

struct Tendon {
  XmlElement element;
  std::vector<std::pair<int, double>> joints;  // and coefficients, none 0
  bool whole = true;                           // are all its joints read?
  bool elsewhere = false;                      // are some of another robot?
};

class Couplings {
 public:
  Couplings(MjcfDocument& document, FileCache& cache, TreeModel& tree,
            const std::set<std::string>& elsewhere, bool tells)
      : document_(document),
        cache_(cache),
        tree_(tree),
        elsewhere_(elsewhere),
        tells_(tells),
        unused_(tells ? document.unused() : told_already_) {
    for (size_t j = 0; j < tree.joints.size(); ++j)
      numbers_[tree.joints[j].name] = static_cast<int>(j);
    for (const MjcfNode* node : document.section("worldbody")) find_names(*node, false);
  }
  void read() {
    read_tendons();
    for (const MjcfNode* node : document_.section("equality")) read_equality(node->element);
    for (const MjcfNode* node : document_.section("actuator")) read_actuator(node->element);
    mark_passive();
  }

 private:
  void warn(const XmlElement& at, const std::string& what) const {
    cache_.warn(at.place() + ": " + what);
  }
  void find_names(const MjcfNode& node, bool copied);
  bool concerns(const XmlValues& values) const;
  std::string why_not(const std::string& name) const;
  std::optional<int> joint(const XmlValues& values, const char* attribute);
  const Tendon& tendon(const XmlValues& values, const char* attribute) const;
  int leader_of(int joint) const;
  void follow(const XmlElement& at, int follower, int leader, double ratio, double offset);
  void read_tendons();
  void read_equality(const XmlElement& element);
  void tie_joint(const XmlElement& element, const XmlValues& values);
  void tie_tendon(const XmlElement& element, const XmlValues& values);
  void read_actuator(const XmlElement& element);
  ActuatorSpec actuator_spec(const XmlElement& element, const XmlValues& values);
  void take_gains(const ActuatorSpec& servo, const Tendon* tendon);
  void drive_joint(const XmlElement& element, const XmlValues& values, int joint);
  void drive_tendon(const XmlElement& element, const Tendon& tendon);
  void take_control_range(const XmlElement& element, const XmlValues& values, TreeJoint& joint,
                          double gear);
  void mark_passive();

  MjcfDocument& document_;
  FileCache& cache_;
  TreeModel& tree_;
  std::map<std::string, int> numbers_;
  std::map<std::string, bool>
      others_;                       // joints in the file by another name or none: are they free?
  std::vector<std::string> copied_;  // beginnings of the names of joints in <replicate>
  bool attaches_ = false;            // are there joints whose names another file gives?
  std::map<std::string, Tendon> tendons_;
  std::vector<int> driven_;
  std::vector<int> turns_of_balls_;  // what became of balls that were asked for
  bool has_actuators_ = false;
  const std::set<std::string>& elsewhere_;  // joints of other robots
  const bool tells_;                        // of what concerns no joint at all
  UnusedXml told_already_;
  UnusedXml& unused_;
  std::set<std::string> unknown_laws_;
};

/// Does it concern this robot? What names joints of others alone does not; what names none is told
/// once.
bool Couplings::concerns(const XmlValues& values) const {
  bool others = false;
  for (const char* attribute : {"joint", "jointinparent", "joint1", "joint2"}) {
    const std::string name = values.text(attribute, "");
    if (numbers_.contains(name) || numbers_.contains(name + "_x")) return true;
    others = others || elsewhere_.contains(name);
  }
  for (const char* attribute : {"tendon", "tendon1", "tendon2"}) {
    const auto found = tendons_.find(values.text(attribute, ""));
    if (found == tendons_.end()) continue;
    if (!found->second.joints.empty()) return true;
    others = others || found->second.elsewhere;
  }
  return tells_ && !others;
}

/// Names of joints that are no joints of the robot, or not under their names.
void Couplings::find_names(const MjcfNode& node, bool copied) {
  const std::string kind = node.name();
  if (kind == "joint" || kind == "freejoint") {
    const std::string name = node.element.attribute("name").value_or("");
    const bool free = kind == "freejoint" || node.element.attribute("type").value_or("") == "free";
    if (!name.empty() && !numbers_.contains(name)) others_[name] = free;
    if (!name.empty() && copied) copied_.push_back(name);
  }
  attaches_ = attaches_ || kind == "attach" || kind == "composite" || kind == "flexcomp";
  for (const MjcfNode& child : node.children) find_names(child, copied || kind == "replicate");
}

/// Why a name of the file is none of the robot's joints; empty: it stands nowhere.
std::string Couplings::why_not(const std::string& name) const {
  if (numbers_.contains(name + "_x")) return "is a ball, which became three turns";
  if (elsewhere_.contains(name)) return "is of another robot";
  if (const auto found = others_.find(name); found != others_.end())
    return found->second ? "is free, and no joint of the robot" : "is of a body that is not read";
  for (const std::string& first : copied_)
    if (name.starts_with(first)) return "is of a <replicate>, which is not read";
  return attaches_ ? "may be of an <attach> or <composite>, which are not read" : "";
}

/// Empty, with a warning, when the joint is in the file but not in the robot.
std::optional<int> Couplings::joint(const XmlValues& values, const char* attribute) {
  const std::string name = values.text(attribute);
  const auto found = numbers_.find(name);
  if (found != numbers_.end()) return found->second;
  if (const std::string why = why_not(name); !why.empty()) {
    warn(values.element(), fmt::format("{}: joint {} {}; this is not used",
                                       excerpt(values.element().name()), in_quotes(name), why));
    // what moves it does move it
    for (const char* axis : {"_x", "_y", "_z"})
      if (const auto turn = numbers_.find(name + axis); turn != numbers_.end())
        turns_of_balls_.push_back(turn->second);
    return {};
  }
  values.fail(attribute, "no joint {}{}", in_quotes(name), did_you_mean(name, names_in(numbers_)));
}

const Tendon& Couplings::tendon(const XmlValues& values, const char* attribute) const {
  const std::string name = values.text(attribute);
  const auto found = tendons_.find(name);
  if (found != tendons_.end()) return found->second;
  values.fail(attribute, "no tendon {}{}", in_quotes(name), did_you_mean(name, names_in(tendons_)));
}

/// The joint at the end of the row of leaders; -1 when the row runs in a circle.
int Couplings::leader_of(int joint) const {
  for (size_t i = 0; i <= tree_.joints.size(); ++i) {
    if (tree_.joints[joint].leader < 0) return joint;
    joint = tree_.joints[joint].leader;
  }
  return -1;
}

void Couplings::follow(const XmlElement& at, int follower, int leader, double ratio,
                       double offset) {
  TreeJoint& joint = tree_.joints[follower];
  if (joint.leader >= 0 || leader_of(leader) == follower) {
    warn(at, fmt::format("joint '{}' is tied already; this does not tie it to '{}'",
                         excerpt(joint.name), excerpt(tree_.joints[leader].name)));
    return;
  }
  joint.leader = leader;
  joint.ratio = ratio;
  joint.offset = offset;
}

// --- tendons and equalities ---

void Couplings::read_tendons() {
  for (const MjcfNode* node : document_.section("tendon")) {
    if (node->name() != "fixed") {
      unused_.element(node->element);
      // its name is known all the same
      if (const auto name = node->element.attribute("name")) tendons_[*name] = {node->element, {}};
      continue;
    }
    unused_.attributes(node->element, {"name", "class"});
    Tendon tendon{node->element, {}};
    for (const auto& child : node->children) {
      const XmlValues values(child.element);
      const double coefficient = values.number("coef");
      if (child.name() != "joint")
        unused_.element(child.element);
      else if (elsewhere_.contains(values.text("joint")))
        tendon.whole = false, tendon.elsewhere = true;
      else if (const auto number = joint(values, "joint"); !number)
        tendon.whole = false;
      else if (coefficient != 0)
        tendon.joints.emplace_back(*number, coefficient);
    }
    tendons_[XmlValues(node->element).text("name", "")] = std::move(tendon);
  }
}

void Couplings::tie_joint(const XmlElement& element, const XmlValues& values) {
  document_.unused().attributes(element,
                                {"name", "class", "joint1", "joint2", "polycoef", "active"});
  const auto found = joint(values, "joint1");
  if (!found) return;
  const int follower = *found;
  std::vector<double> c = {0, 1, 0, 0, 0};
  if (values.has("polycoef")) c = values.numbers("polycoef", 1, 5);
  c.resize(5);
  TreeJoint& tied = tree_.joints[follower];
  if (!values.has("joint2")) {
    tied.min = tied.max = tied.motor.default_value = tied.zero + c[0];
    tied.endless = false;
    cache_.note(fmt::format("{}: joint '{}' may only stand at {:.4g} {}, as the equality says",
                            element.place(), excerpt(tied.name), tied.motor.default_value,
                            tied.kind == JointKind::revolute ? "rad" : "m"));
    return;
  }
  if (c[2] != 0 || c[3] != 0 || c[4] != 0)
    warn(element,
         fmt::format("joint '{}': polycoef: only its linear part is used", excerpt(tied.name)));
  const auto second = joint(values, "joint2");
  if (!second) return;
  const int leader = *second;
  if (leader == follower) values.fail("joint2", "expected another joint than joint1");
  if (c[1] == 0)
    cache_.suspected(
        fmt::format("{}: joint '{}': polycoef has no linear part: it stands still when "
                    "'{}' moves",
                    element.place(), excerpt(tied.name), excerpt(tree_.joints[leader].name)));
  // both count from where the model stands at first
  follow(element, follower, leader, c[1], tied.zero + c[0] - c[1] * tree_.joints[leader].zero);
}

/// A tendon of two joints whose length stays ties them: c1 q1 + c2 q2 is constant, polycoef's first
/// number more than where the model stands at first.
void Couplings::tie_tendon(const XmlElement& element, const XmlValues& values) {
  document_.unused().attributes(element,
                                {"name", "class", "tendon1", "tendon2", "polycoef", "active"});
  const Tendon& held = tendon(values, "tendon1");
  if (values.has("tendon2") || held.joints.size() != 2 || !held.whole) {
    warn(element, "equality of tendons: only a fixed tendon of two joints ties them; not used");
    return;
  }
  const auto [a, c_a] = held.joints[0];
  const auto [b, c_b] = held.joints[1];
  if (a == b) return;
  const double ratio = -c_a / c_b;
  const double longer = values.has("polycoef") ? values.numbers("polycoef", 1, 5)[0] : 0;
  follow(element, b, a, ratio, tree_.joints[b].zero - ratio * tree_.joints[a].zero + longer / c_b);
}

void Couplings::read_equality(const XmlElement& element) {
  const XmlValues values = document_.values(element, "", "equality");
  if (!concerns(values)) return;
  if (!values.boolean("active", true)) {
    warn(element, fmt::format("equality: <{}> is not active; not used", excerpt(element.name())));
    return;
  }
  if (element.name() == "joint")
    tie_joint(element, values);
  else if (element.name() == "tendon")
    tie_tendon(element, values);
  else
    warn(element, fmt::format("equality: <{}> would close a loop of bodies; it is left open",
                              excerpt(element.name())));
}

// --- actuators ---

/// What a position servo is told, it cannot exceed.
void Couplings::take_control_range(const XmlElement& element, const XmlValues& values,
                                   TreeJoint& joint, double gear) {
  // a joint that stands still has none to take
  if (joint.min == joint.max) return;
  if (!values.has("ctrlrange") || values.text("ctrllimited", "auto") == "false") return;
  const auto range = values.range("ctrlrange", document_.repairs());
  // two zeros undo what a class says
  const bool zeros = range[0] == 0 && range[1] == 0;
  if (zeros && values.text("ctrllimited", "auto") != "true") return;
  const double a = range[0] / gear, b = range[1] / gear;
  double low = std::min(a, b), high = std::max(a, b);
  if (!joint.endless) low = std::max(joint.min, low), high = std::min(joint.max, high);
  if (low < high || (low == high && range[0] == range[1])) {
    joint.min = low, joint.max = high, joint.endless = false;
    joint.motor.default_value = std::clamp(joint.motor.default_value, low, high);
    if (low == high)
      cache_.note(fmt::format("{}: joint '{}' may only stand at {:.4g}, as ctrlrange says",
                              element.place(), excerpt(joint.name), low));
  } else if (range[0] < range[1]) {
    warn(element, fmt::format("position: ctrlrange has nothing in common with the range of joint "
                              "'{}'; not used",
                              excerpt(joint.name)));
  }
}

void Couplings::drive_joint(const XmlElement& element, const XmlValues& values, int number) {
  TreeJoint& joint = tree_.joints[number];
  driven_.push_back(number);
  const double gear = values.has("gear") ? values.numbers("gear", 1, 6)[0] : 1;
  if (gear == 0) return;
  const auto largest = [&](const char* name) {
    const auto range = values.numbers(name, 2, 2);
    return std::max(std::abs(range[0]), std::abs(range[1])) * std::abs(gear);
  };
  double& effort = joint.motor.max_effort;
  if (values.has("forcerange") && values.text("forcelimited", "auto") != "false")
    effort = largest("forcerange");
  if (element.name() == "motor" && values.has("ctrlrange") && effort == 0)
    effort = largest("ctrlrange");
  if (element.name() == "position") take_control_range(element, values, joint, gear);
}

/// A motor on a tendon moves its joints together: nothing else is said of how they share its
/// length, so each takes its part in proportion to its coefficient.
void Couplings::drive_tendon(const XmlElement& element, const Tendon& tendon) {
  if (tendon.elsewhere && !tendon.joints.empty())
    warn(element, fmt::format("{}: drives a tendon that joins two robots; of each it moves its own "
                              "joints",
                              excerpt(element.name())));
  if (tendon.joints.empty()) {
    warn(element, fmt::format("{}: drives a tendon that is not used", excerpt(element.name())));
    return;
  }
  const auto [first, c_first] = tendon.joints.front();
  const int leader = leader_of(first);
  driven_.push_back(first);
  for (const auto& [number, c] : tendon.joints) {
    driven_.push_back(number);
    if (number == first || tree_.joints[number].leader >= 0 || leader_of(number) == leader)
      continue;
    const double ratio = c / c_first;
    follow(element, number, first, ratio,
           tree_.joints[number].zero - ratio * tree_.joints[first].zero);
    cache_.note(
        fmt::format("{}: joints '{}' and '{}' share a tendon; they are taken to turn as "
                    "1 to {:.4g}",
                    element.place(), excerpt(tree_.joints[first].name),
                    excerpt(tree_.joints[number].name), ratio));
  }
}

/// What a DOF feels of an actuator that pulls it to where its control says, and damps it; those of
/// several add up.
void Couplings::take_gains(const ActuatorSpec& servo, const Tendon* tendon) {
  const int leader = leader_of(servo.dof);
  if (!servo.law_known || leader < 0) return;
  const auto ratio = [&](int number) { return number == leader ? 1 : tree_.joints[number].ratio; };
  double reach =
      tendon ? 0 : servo.gear * ratio(servo.dof);  // of its length, for a unit of the DOF
  if (tendon)
    for (const auto& [number, c] : tendon->joints)
      if (leader_of(number) == leader) reach += servo.gear * c * ratio(number);
  DofSpec& motor = tree_.joints[leader].motor;
  motor.kp += std::max(0.0, -servo.bias[1]) * reach * reach;
  motor.kd += std::max(0.0, -servo.bias[2]) * reach * reach;
  motor.damping_ratio = std::max(motor.damping_ratio, servo.damping_ratio);
  if (tendon && servo.force_range)
    motor.max_effort =
        std::max(std::abs((*servo.force_range)[0]), std::abs((*servo.force_range)[1])) *
        std::abs(reach);
}

/// As a file says it, with how its force follows from control, length and velocity.
ActuatorSpec Couplings::actuator_spec(const XmlElement& element, const XmlValues& values) {
  ActuatorSpec out;
  out.kind = element.name();
  out.name = values.text("name", "");
  out.joint = values.text("joint", values.text("jointinparent", ""));
  if (out.joint.empty()) out.tendon = values.text("tendon", "");
  if (values.has("gear")) out.gear = values.numbers("gear", 1, 6)[0];
  const auto limits = [&](const char* range, const char* limited) {
    std::optional<std::array<double, 2>> bounds;
    if (!values.has(range) || values.text(limited, "auto") == "false") return bounds;
    auto both = values.numbers(range, 2, 2);
    if (both[0] > both[1]) {
      // of a servo's that was told before
      if (out.kind != "position" || out.joint.empty() || range != std::string_view("ctrlrange"))
        values.range(range, document_.repairs());
      std::swap(both[0], both[1]);
    }
    if (both[0] != 0 || both[1] != 0) bounds = std::array{both[0], both[1]};
    return bounds;
  };
  out.control_range = limits("ctrlrange", "ctrllimited");
  out.force_range = limits("forcerange", "forcelimited");
  if (out.kind == "position") {
    out.gain = values.not_negative("kp", 1, document_.repairs());
    out.bias = {0, -out.gain, -values.not_negative("kv", 0, document_.repairs())};
    out.damping_ratio = values.not_negative("dampratio", 0, document_.repairs());
  } else if (out.kind == "velocity") {
    out.gain = values.not_negative("kv", 1, document_.repairs());
    out.bias = {0, 0, -out.gain};
  } else if (out.kind == "general") {
    if (values.has("gainprm")) out.gain = values.numbers("gainprm", 1, 100)[0];
    const std::string bias = values.text("biastype", "none");
    if (bias == "affine" && values.has("biasprm")) {
      const auto given = values.numbers("biasprm", 1, 100);
      for (size_t i = 0; i < std::min<size_t>(3, given.size()); ++i) out.bias[i] = given[i];
      // of a servo's a positive number is a ratio
      if (out.bias[2] > 0 && out.gain == -out.bias[1])
        out.damping_ratio = std::exchange(out.bias[2], 0);
    }
    out.law_known = (bias == "none" || bias == "affine") &&
                    values.text("gaintype", "fixed") == "fixed" &&
                    values.text("dyntype", "none") == "none";
  } else {
    out.law_known = out.kind == "motor";
  }
  if (!out.law_known && unknown_laws_.insert(out.kind).second)
    warn(element, fmt::format("<{}>: how its force follows from its control is not kept",
                              excerpt(out.kind)));
  return out;
}

void Couplings::read_actuator(const XmlElement& element) {
  const XmlValues values = document_.values(element, "", "general");
  const bool on_joint = values.has("joint") || values.has("jointinparent");
  if (on_joint || values.has("tendon")) has_actuators_ = true;
  if (!concerns(values)) return;
  values.tell_unused(document_.unused(),
                     {"name", "class", "joint", "jointinparent", "tendon", "ctrlrange",
                      "ctrllimited", "forcerange", "forcelimited", "kp", "kv", "dampratio", "gear",
                      "gaintype", "gainprm", "biastype", "biasprm", "dyntype"});
  int moved = -1;
  const Tendon* pulled = nullptr;
  if (on_joint) {
    turns_of_balls_.clear();
    const auto number = joint(values, values.has("joint") ? "joint" : "jointinparent");
    if (number)
      drive_joint(element, values, *number);
    else
      driven_.insert(driven_.end(), turns_of_balls_.begin(), turns_of_balls_.end());
    if (!number) return;
    moved = *number;
  } else if (values.has("tendon")) {
    pulled = &tendon(values, "tendon");
    drive_tendon(element, *pulled);
    if (pulled->joints.empty()) return;
    moved = pulled->joints.front().first;
  } else {
    document_.unused().element(element);
    return;
  }
  tree_.actuators.push_back(actuator_spec(element, values));
  tree_.actuators.back().dof = moved;
  take_gains(tree_.actuators.back(), pulled);
}

void Couplings::mark_passive() {
  for (auto& joint : tree_.joints) joint.motor.driven = false;
  for (const int number : driven_)
    if (leader_of(number) >= 0) tree_.joints[leader_of(number)].motor.driven = true;
  // of a model without actuators all joints may be meant to close
  if (!has_actuators_) return;
  for (auto& joint : tree_.joints) joint.passive = !joint.motor.driven;
  std::string names;
  int count = 0;
  for (const auto& joint : tree_.joints)
    if (joint.passive && joint.leader < 0 && ++count <= 6)
      names += fmt::format("{}'{}'", count > 1 ? ", " : "", excerpt(joint.name));
  if (count > 0)
    cache_.note(fmt::format("{}: joints that no actuator drives do not close: {}{}",
                            document_.file(), names, count > 6 ? " and others" : ""));
}

}  // namespace

void read_mjcf_couplings(MjcfDocument& document, FileCache& cache, TreeModel& tree,
                         const std::set<std::string>& elsewhere, bool tells) {
  Couplings(document, cache, tree, elsewhere, tells).read();
}

}  // namespace clench
