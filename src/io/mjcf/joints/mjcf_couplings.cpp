#include "clench/io/mjcf/joints/mjcf_couplings.h"

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/io/mjcf/joints/mjcf_drives.h"
#include "clench/io/mjcf/joints/mjcf_ties.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace {

// an actuator stores one number per joint of its tendon
constexpr size_t max_pulled_joints = 200'000;

class Couplings {
 public:
  Couplings(MjcfDocument& document, FileCache& cache, TreeModel& tree, const MjcfFileJoints& joints,
            const MjcfNode* trunk, bool tells)
      : document_(document),
        cache_(cache),
        tree_(tree),
        file_joints_(joints),
        is_one_of_several_(trunk),
        tells_(tells),
        unused_(tells ? document.unused() : told_already_),
        switches_(read_actuator_switches(document)) {
    for (size_t j = 0; j < tree.joints.size(); ++j)
      numbers_[tree.joints[j].name] = static_cast<int>(j);
    if (trunk) count_joint_names(*trunk, own_joints_);
  }
  void read() {
    read_tendons();
    for (const MjcfNode* node : document_.section("equality")) read_equality(node->element);
    for (const MjcfNode* node : document_.section("actuator")) read_actuator(node->element);
    tell_unused();
    apply_mjcf_drives(drives_, document_, cache_, tree_);
    for (const MjcfTendon& tendon : tendons_) add_tendon_dynamics(tendon, document_, cache_, tree_);
    tree_.has_actuators = has_actuators_;
  }

 private:
  bool is_elsewhere(const std::string& name) const;
  bool concerns(const XmlValues& values) const;
  std::string why_not(const std::string& name) const;
  std::optional<int> joint(const XmlValues& values, const char* attribute);
  const MjcfTendon* find_tendon(const std::string& name) const;
  void keep(MjcfTendon tendon);
  const MjcfTendon& tendon(const XmlValues& values, const char* attribute) const;
  void read_tendons();
  void read_equality(const XmlElement& element);
  void tie_joints(const XmlElement& element, const XmlValues& values);
  void tie_tendon(const XmlElement& element, const XmlValues& values);
  void read_actuator(const XmlElement& element);
  void tell_law(const MjcfActuator& actuator);
  struct Unused;
  static void add_unused(std::map<std::string, Unused>& kinds, const std::string& kind,
                         const XmlElement& element, const XmlValues& values);
  void tell_unused() const;

  MjcfDocument& document_;
  FileCache& cache_;
  TreeModel& tree_;
  std::map<std::string, int> numbers_;
  std::deque<MjcfTendon> tendons_;
  std::map<std::string, size_t> tendon_numbers_;
  size_t pulled_joints_ = 0;  // of all actuators
  std::vector<MjcfDrive> drives_;
  bool has_actuators_ = false;
  const MjcfFileJoints& file_joints_;
  const bool is_one_of_several_;
  std::map<std::string, int> own_joints_;  // as MjcfFileJoints::in_trees
  const bool tells_;                       // reports elements that concern no joint
  UnusedXml told_already_;
  UnusedXml& unused_;
  const MjcfActuatorSwitches switches_;
  std::set<std::string> unknown_laws_;
  /// Elements that are not used, by kind: the place of the first, and names.
  struct Unused {
    Place place;
    std::vector<std::string> names = {};
  };
  std::map<std::string, Unused> loops_, targets_;
};

/// True if an element concerns this robot. Elements that name only joints of other robots do not;
/// those that name no joint are reported once.
bool Couplings::concerns(const XmlValues& values) const {
  bool others = false;
  for (const char* attribute : {"joint", "jointinparent", "joint1", "joint2"}) {
    const std::string name = values.text(attribute, "");
    if (numbers_.contains(name) || numbers_.contains(name + "_x")) return true;
    others = others || is_elsewhere(name);
  }
  for (const char* attribute : {"tendon", "tendon1", "tendon2"}) {
    const MjcfTendon* found = find_tendon(values.text(attribute, ""));
    if (!found) continue;
    if (!found->joints.empty()) return true;
    others = others || found->elsewhere;
  }
  return tells_ && !others;
}

/// True if another robot of the file has a joint of this name.
bool Couplings::is_elsewhere(const std::string& name) const {
  if (!is_one_of_several_) return false;
  const auto all = file_joints_.in_trees.find(name);
  if (all == file_joints_.in_trees.end()) return false;
  const auto own = own_joints_.find(name);
  return own == own_joints_.end() || all->second > own->second;
}

/// Reason why the robot lacks a joint of this name; empty if the file has no such joint.
std::string Couplings::why_not(const std::string& name) const {
  if (numbers_.contains(name + "_x")) return "is a ball, which became three hinges";
  if (is_elsewhere(name)) return "belongs to another robot";
  if (const auto found = file_joints_.is_free.find(name); found != file_joints_.is_free.end())
    return found->second ? "is free, and does not belong to the robot"
                         : "belongs to a body that is not read";
  return file_joints_.composes ? "may be of a <composite> or <flexcomp>, which are not read" : "";
}

/// Empty, with a warning, if the joint is in the file but not in the robot.
std::optional<int> Couplings::joint(const XmlValues& values, const char* attribute) {
  const std::string name = values.text(attribute);
  const auto found = numbers_.find(name);
  if (found != numbers_.end()) return found->second;
  if (const std::string why = why_not(name); !why.empty()) {
    cache_.diagnostics().warn(values.element().place().of(excerpt(values.element().name())),
                              "joint {} {}; this is not used", in_quotes(name), why);
    return {};
  }
  values.fail(attribute, "no joint {}{}", in_quotes(name), did_you_mean(name, names_in(numbers_)));
}

/// Null if there is no such joint.
const MjcfTendon* Couplings::find_tendon(const std::string& name) const {
  const auto found = tendon_numbers_.find(name);
  return found == tendon_numbers_.end() ? nullptr : &tendons_[found->second];
}

void Couplings::keep(MjcfTendon tendon) {
  // if a name is repeated, the last one is used
  if (!tendon.name.empty()) tendon_numbers_[tendon.name] = tendons_.size();
  tendons_.push_back(std::move(tendon));
}

const MjcfTendon& Couplings::tendon(const XmlValues& values, const char* attribute) const {
  const std::string name = values.text(attribute);
  if (const MjcfTendon* found = find_tendon(name)) return *found;
  std::vector<std::string> names;
  for (const MjcfTendon& tendon : tendons_) names.push_back(tendon.name);
  values.fail(attribute, "no tendon {}{}", in_quotes(name), did_you_mean(name, names));
}

// --- tendons and equalities ---

void Couplings::read_tendons() {
  for (const MjcfNode* node : document_.section("tendon")) {
    check_stop();
    MjcfTendon tendon = read_mjcf_tendon(document_, node->element);
    if (tendon.spatial) {
      unused_.element(node->element);
      // its name can be referenced nevertheless
      keep(std::move(tendon));
      continue;
    }
    for (const auto& child : node->children) {
      check_stop();
      const XmlValues values(child.element);
      const double coefficient = values.number("coef");
      if (child.name() != "joint")
        unused_.element(child.element);
      else if (is_elsewhere(values.text("joint")))
        tendon.complete = false, tendon.elsewhere = true;
      else if (const auto number = joint(values, "joint"); !number)
        tendon.complete = false;
      else if (coefficient != 0)
        tendon.joints.emplace_back(*number, coefficient);
    }
    keep(std::move(tendon));
  }
}

void Couplings::tie_joints(const XmlElement& element, const XmlValues& values) {
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
    cache_.diagnostics().note(element.place(),
                              "joint '{}' is fixed at {:.4g} {} because of the equality",
                              excerpt(tied.name), tied.motor.default_value,
                              tied.kind == JointKind::revolute ? "rad" : "m");
    return;
  }
  if (c[2] != 0 || c[3] != 0 || c[4] != 0)
    cache_.diagnostics().warn(element.place().of("joint '{}'", excerpt(tied.name)),
                              "polycoef: only its linear part is used");
  const auto second = joint(values, "joint2");
  if (!second) return;
  const int leader = *second;
  if (leader == follower) values.fail("joint2", "expected another joint than joint1");
  if (c[1] == 0)
    cache_.diagnostics().suspected(element.place().of("joint '{}'", excerpt(tied.name)),
                                   "polycoef has no linear part: it does not move with '{}'",
                                   excerpt(tree_.joints[leader].name));
  // both are relative to the initial configuration
  tie_joint(tree_, follower, leader, c[1], tied.zero + c[0] - c[1] * tree_.joints[leader].zero,
            element, cache_);
}

/// A tendon of two joints with constant length couples them: c1 q1 + c2 q2 exceeds its value in the
/// initial configuration by polycoef's first number.
void Couplings::tie_tendon(const XmlElement& element, const XmlValues& values) {
  document_.unused().attributes(element,
                                {"name", "class", "tendon1", "tendon2", "polycoef", "active"});
  const MjcfTendon& held = tendon(values, "tendon1");
  if (values.has("tendon2") || held.joints.size() != 2 || !held.complete) {
    cache_.diagnostics().warn(
        element.place(),
        "equality of tendons: only a fixed tendon of two joints ties them; not used");
    return;
  }
  const auto [a, c_a] = held.joints[0];
  const auto [b, c_b] = held.joints[1];
  if (a == b) return;
  const double ratio = -c_a / c_b;
  const double longer = values.has("polycoef") ? values.numbers("polycoef", 1, 5)[0] : 0;
  tie_joint(tree_, b, a, ratio, tree_.joints[b].zero - ratio * tree_.joints[a].zero + longer / c_b,
            element, cache_);
}

void Couplings::read_equality(const XmlElement& element) {
  check_stop();
  const XmlValues values = document_.values(element, "", "equality");
  if (!concerns(values)) return;
  if (!values.boolean("active", true)) {
    cache_.diagnostics().warn(element.place().of("equality"), "<{}> is not active; not used",
                              excerpt(element.name()));
    return;
  }
  if (element.name() == "joint")
    tie_joints(element, values);
  else if (element.name() == "tendon")
    tie_tendon(element, values);
  else
    add_unused(loops_, std::string(element.name()), element, values);
}

// --- actuators ---

/// Warns, once per kind, of dynamics between control and force that are not simulated.
void Couplings::tell_law(const MjcfActuator& actuator) {
  const std::string& kind = actuator.spec.kind;
  const XmlElement& element = actuator.values.element();
  if (!actuator.spec.law_known && unknown_laws_.insert(kind).second)
    cache_.diagnostics().warn(element.place().of("<{}>", excerpt(kind)),
                              "the law of its force is not kept");
  if (!actuator.spec.law_known) return;
  if (actuator.spec.gain_slopes != std::array{0.0, 0.0} && unknown_laws_.insert(kind).second)
    cache_.diagnostics().warn(element.place().of("<{}>", excerpt(kind)),
                              "its gain, which depends on length or velocity, affects efforts at "
                              "rest, but not the motors of a run");
  if (actuator.dynamics == "none" || !unknown_laws_.insert(kind + " " + actuator.dynamics).second)
    return;
  if (actuator.dynamics == "integrator")
    cache_.diagnostics().warn(
        element.place().of("<{}>", excerpt(kind)),
        "targets of its motor represent its activation, the integral of its control");
  else
    cache_.diagnostics().warn(
        element.place().of("<{}>", excerpt(kind)),
        "its control acts at once: the time constant of its filter is not used");
}

void Couplings::read_actuator(const XmlElement& element) {
  check_stop();
  MjcfActuator actuator = read_mjcf_actuator(document_, element);
  const XmlValues& values = actuator.values;
  const bool on_joint = values.has("joint") || values.has("jointinparent");
  if (on_joint || values.has("tendon")) has_actuators_ = true;
  if (!concerns(values)) return;
  values.tell_unused(document_.unused(),
                     {"name",      "class",       "joint",      "jointinparent", "tendon",
                      "site",      "refsite",     "body",       "cranksite",     "slidersite",
                      "ctrlrange", "ctrllimited", "forcerange", "forcelimited",  "kp",
                      "kv",        "dampratio",   "timeconst",  "inheritrange",  "gear",
                      "gaintype",  "gainprm",     "biastype",   "biasprm",       "dyntype",
                      "group",     "actrange",    "actlimited", "area",          "diameter",
                      "bias",      "range",       "force",      "scale",         "lmin",
                      "lmax",      "vmax",        "fpmax",      "fvmax"});
  MjcfDrive drive;
  if (on_joint) {
    const auto number = joint(values, values.has("joint") ? "joint" : "jointinparent");
    if (!number) return;
    drive.joint = *number;
  } else if (values.has("tendon")) {
    drive.tendon = &tendon(values, "tendon");
    if (drive.tendon->joints.empty())
      return add_unused(targets_, "tendon that is not read", element, values);
    if (drive.tendon->elsewhere)
      cache_.diagnostics().warn(
          element.place().of(excerpt(element.name())),
          "drives a tendon of two robots; in each robot it moves the joints of that robot");
  } else {
    for (const char* target : {"site", "body", "cranksite"})
      if (values.has(target)) return add_unused(targets_, target, element, values);
    document_.unused().element(element);
    return;
  }
  pulled_joints_ += drive.tendon ? drive.tendon->joints.size() : 1;
  if (pulled_joints_ > max_pulled_joints)
    element.fail(
        "{}: expected actuators that pull at most {} joints, each counted once per actuator",
        excerpt(element.name()), max_pulled_joints);
  tell_law(actuator);
  actuator.spec.enabled = !switches_.off(actuator.group);
  drive.actuator = std::move(actuator);
  drives_.push_back(std::move(drive));
}

void Couplings::add_unused(std::map<std::string, Unused>& kinds, const std::string& kind,
                           const XmlElement& element, const XmlValues& values) {
  Unused& unused = kinds.try_emplace(kind, Unused{element.place()}).first->second;
  unused.names.push_back(values.text("name", std::string(element.name())));
}

void Couplings::tell_unused() const {
  for (const auto& [kind, loop] : loops_)
    cache_.diagnostics().warn(loop.place.of("equality"),
                              "<{}> would close a loop of bodies; it is left open: {}",
                              excerpt(kind), some_names(loop.names));
  for (const auto& [kind, target] : targets_)
    cache_.diagnostics().warn(target.place, "actuators whose target is a {} are not used: {}",
                              kind == "cranksite" ? "slider-crank" : kind,
                              some_names(target.names));
}

}  // namespace

void MjcfFileJoints::add(const MjcfNode& node) {
  check_stop();
  const std::string kind = node.name();
  if (kind == "joint" || kind == "freejoint") {
    const std::string name = node.element.attribute("name").value_or("");
    const bool free = kind == "freejoint" || node.element.attribute("type").value_or("") == "free";
    if (!name.empty()) is_free[name] = free;
  }
  composes = composes || kind == "composite" || kind == "flexcomp";
  for (const MjcfNode& child : node.children) add(child);
}

void count_joint_names(const MjcfNode& node, std::map<std::string, int>& into) {
  for (const MjcfNode& child : node.children) {
    if (child.name() == "joint")
      if (const auto name = child.element.attribute("name")) ++into[*name];
    count_joint_names(child, into);
  }
}

void read_mjcf_couplings(MjcfDocument& document, FileCache& cache, TreeModel& tree,
                         const MjcfFileJoints& joints, const MjcfNode* trunk, bool tells) {
  Couplings(document, cache, tree, joints, trunk, tells).read();
}

}  // namespace clench
