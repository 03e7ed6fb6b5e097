#include "clench/io/graspit/graspit_readers.h"

#include <algorithm>

#include "clench/base/suggest.h"
#include "clench/base/units.h"
#include "clench/io/graspit/robot_files.h"
#include "clench/io/graspit/robot_parts.h"
#include "clench/io/graspit/tendons_xml.h"
#include "clench/io/graspit/transform_tags.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/repair_names.h"
#include "clench/io/text/repairs.h"
#include "clench/io/text/xml.h"
#include "clench/spec/compliant_coupling.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

constexpr size_t max_elements = 1000;  // limit of DOFs, chains, joints, links: far above any hand

class XmlRobotReader {
 public:
  XmlRobotReader(const XmlElement& root, const fs::path& path, FileCache& cache)
      : root_(root), path_(path), cache_(cache), repairs_(cache.diagnostics()) {}
  RobotSpec read();

 private:
  struct PairOff {
    XmlElement element;
    ChainPlace a, b;
  };

  const Diagnostics& diagnostics() const { return cache_.diagnostics(); }
  void read_type();
  void read_dof(const XmlElement& element);
  void read_chain(const XmlElement& element);
  void read_joint(const XmlElement& element, ChainLinks& chain);
  DenavitHartenberg read_expression(const XmlElement& element, JointSpec& joint,
                                    const std::string& subject);
  void read_limits(const XmlElement& element, JointSpec& joint, const std::string& subject);
  double magnitude(const XmlElement& parent, const char* name, const std::string& subject);
  double number_or_zero(const XmlElement& parent, const char* name, const std::string& subject);
  void read_link(const XmlElement& element, ChainLinks& chain, ChainPlace place);
  void read_rule(const XmlElement& link, ChainPlace place);
  void read_disabled_pair(const XmlElement& element);
  void set_dof_units();
  void read_approach();
  void read_tracker();
  void read_files();
  int part(const XmlElement& element, ChainPlace place) const;
  NamedFile named(const char* name) const;

  const XmlElement root_;
  const fs::path& path_;
  FileCache& cache_;
  Repairs repairs_;
  std::vector<XmlElement> dofs_;
  DofKinds dof_kinds_;
  std::vector<Chain> chains_;
  std::vector<PairOff> pairs_off_;  // resolved when all links are known
  RobotSpec robot_;
};

RobotSpec XmlRobotReader::read() {
  root_.check({.once = {"palm", "approachDirection", "eigenGrasps", "virtualContacts", "cyberGlove",
                        "flockOfBirds"},
               .many = {"dof", "chain", "disableCollision", "tendon", "tendonWrapper"},
               .attributes = {"type", "DBName"}},
              diagnostics());
  robot_.name = path_.stem().string();
  robot_.source = path_.generic_string();
  read_type();
  robot_.database_name = root_.attribute("DBName").value_or("");
  const XmlElement palm = root_.expected("palm");
  palm.check({}, diagnostics());
  robot_.base = cache_.part(palm.text(), path_, palm.place());
  robot_.base.name = robot_.name + "_base";
  dofs_ = root_.children("dof");
  const auto chains = root_.children("chain");
  if (dofs_.size() > max_elements || chains.size() > max_elements)
    root_.fail("expected at most {} DOFs and chains, got {} and {}", max_elements, dofs_.size(),
               chains.size());
  dof_kinds_.resize(dofs_.size());
  for (const XmlElement& e : chains) read_chain(e);
  for (const XmlElement& e : dofs_) read_dof(e);
  couple_by_springs(robot_);
  set_dof_units();
  for (const XmlElement& e : root_.children("disableCollision")) read_disabled_pair(e);
  for (const auto& [element, a, b] : pairs_off_)
    robot_.collision_rules.pairs_off.push_back({part(element, a), part(element, b)});
  robot_.collision_rules.near_pairs_off = true;
  read_tendons(
      root_, [&](const XmlElement& e, ChainPlace place) { return part(e, place); }, diagnostics(),
      repairs_, robot_);
  read_approach();
  read_tracker();
  check_read_robot(robot_, root_.place(), cache_.options());
  repairs_.tell();
  read_files();
  return std::move(robot_);
}

void XmlRobotReader::read_type() {
  robot_.class_name = root_.attribute("type").value_or("");
  if (robot_.class_name.empty()) {
    diagnostics().note(root_.place().of("robot"), "no type; Hand is assumed");
    robot_.class_name = "Hand";
  } else {
    check_class(robot_.class_name, root_.place(), diagnostics());
  }
}

int XmlRobotReader::part(const XmlElement& element, ChainPlace place) const {
  if (place.chain >= static_cast<int>(chains_.size()))
    element.fail("{}: expected one of {} chains, got {}", element.name(), chains_.size(),
                 place.chain);
  const auto link = link_at(chains_, place);
  if (!link)
    element.fail("{}: expected one of {} links of chain {}, got {}", element.name(),
                 chains_[place.chain].links.size(), place.chain, place.link);
  return *link;
}

// --- DOFs; their units depend on the kind of their joints ---

/// check_robot checks the range of each quantity later; here only overflow of products is
/// prevented.
static double bounded(const XmlElement& element, const std::string& subject) {
  const double x = element.number();
  if (const auto wrong = fault(number_rule, x); !wrong.empty())
    element.fail("{}: {}: {}", subject, element.name(), wrong);
  return x;
}

/// A value that must not be negative; 0 if absent.
double XmlRobotReader::magnitude(const XmlElement& parent, const char* name,
                                 const std::string& subject) {
  const XmlElement child = parent.child(name);
  if (!child) return 0;
  return repairs_.magnitude(bounded(child, subject), child.place().of(subject).of(name));
}

/// A value that is 0 if missing, which is reported.
double XmlRobotReader::number_or_zero(const XmlElement& parent, const char* name,
                                      const std::string& subject) {
  if (const XmlElement child = parent.child(name)) return bounded(child, subject);
  repairs_.add("missing", parent.place().of(subject), "<{}> is missing; 0 is used", name);
  return 0;
}

void XmlRobotReader::read_dof(const XmlElement& element) {
  element.check({.once = {"defaultVelocity", "defaultValue", "maxEffort", "Kp", "Kd",
                          "draggerScale", "breakAwayTorque"},
                 .attributes = {"type"}},
                diagnostics());
  const size_t i = robot_.dofs.size();
  if (!dof_kinds_[i]) diagnostics().suspected(element.place(), "DOF {} moves no joint", i);
  DofSpec dof;
  const std::string subject = fmt::format("DOF {}", i);
  const Place place = element.place().of(subject);
  const std::string kind = element.attribute("type").value_or("");
  if (kind.empty())
    repairs_.add("kind", place, "no type; r is assumed");
  else
    dof.kind = dof_kind(kind, place.text());
  const auto number = [&](const char* name) {
    const XmlElement child = element.child(name);
    return child ? bounded(child, subject) : 0.0;
  };
  dof.default_velocity = number_or_zero(element, "defaultVelocity", subject);
  dof.default_value = number("defaultValue");
  dof.max_effort = magnitude(element, "maxEffort", subject);
  dof.kp = number("Kp");
  dof.kd = number("Kd");
  dof.dragger_scale = number("draggerScale");
  if (dof.kind == DofKind::breakaway)
    dof.breakaway_torque = magnitude(element, "breakAwayTorque", subject);
  robot_.dofs.push_back(in_si(dof, dof_kinds_[i] == JointKind::prismatic));
}

void XmlRobotReader::set_dof_units() {
  for (size_t i = 0; i < dofs_.size(); ++i) {
    const auto range = dof_range(robot_, static_cast<int>(i));
    const auto [low, high] = range;
    if (low > high) dofs_[i].fail("DOF {}: {}", i, no_range(range));
    DofSpec& dof = robot_.dofs[i];
    if (dof.default_value < low || dof.default_value > high) {
      // the implicit default 0 is moved without a message
      if (const XmlElement given = dofs_[i].child("defaultValue"))
        diagnostics().repaired(given.place().of("DOF {}", i),
                               "defaultValue {} is outside its range; moved to the limit",
                               given.text());
      dof.default_value = std::clamp(dof.default_value, low, high);
    }
  }
}

// --- chains ---

void XmlRobotReader::read_chain(const XmlElement& element) {
  element.check({.once = {"transform"}, .many = {"joint", "link", "filter"}}, diagnostics());
  const int number = static_cast<int>(chains_.size());
  const auto joints = element.children("joint"), links = element.children("link");
  if (joints.size() > max_elements || links.size() > max_elements)
    element.fail("chain: expected at most {} joints and links, got {} and {}", max_elements,
                 joints.size(), links.size());
  if (links.empty()) element.fail("chain: expected a link, got none");
  ChainLinks chain(read_transform_of(element, cache_.diagnostics()), dof_kinds_);
  for (const XmlElement& e : joints) read_joint(e, chain);
  chains_.emplace_back();
  for (int l = 0; l < static_cast<int>(links.size()); ++l) {
    chains_.back().links.push_back(static_cast<int>(robot_.links.size()));
    read_link(links[l], chain, {number, l});
  }
  if (chain.last_joint() + 1 < chain.joints())
    diagnostics().warn(element.place().of("chain {}", number),
                       "joints from {} on move no link, and are not used", chain.last_joint() + 1);
  read_tactile(
      element, number, [&](const XmlElement& e, ChainPlace place) { return part(e, place); },
      diagnostics(), repairs_, robot_);
}

void XmlRobotReader::read_joint(const XmlElement& element, ChainLinks& chain) {
  element.check({.once = {"theta", "d", "a", "alpha", "minValue", "maxValue", "viscousFriction",
                          "CoulombFriction", "springStiffness", "restValue"},
                 .attributes = {"type"}},
                diagnostics());
  const std::string subject = fmt::format("joint {}", chain.joints());
  JointSpec joint;
  const std::string type = element.expected_attribute("type");
  if (lower_case(type) == "prismatic")
    joint.kind = JointKind::prismatic;
  else if (lower_case(type) != "revolute")
    element.fail("{}: expected type Revolute or Prismatic, got {}{}", subject, in_quotes(type),
                 did_you_mean(type, {"Revolute", "Prismatic"}));
  DenavitHartenberg numbers = read_expression(element, joint, subject);
  numbers.a = number_or_zero(element, "a", subject);
  numbers.alpha = number_or_zero(element, "alpha", subject);
  read_limits(element, joint, subject);
  joint.viscous = magnitude(element, "viscousFriction", subject);
  joint.coulomb = magnitude(element, "CoulombFriction", subject);
  joint.spring = magnitude(element, "springStiffness", subject);
  if (const XmlElement rest = element.child("restValue")) joint.rest = rest.number();
  errors_at(element, [&] { chain.add_joint(joint, numbers); });
}

DenavitHartenberg XmlRobotReader::read_expression(const XmlElement& element, JointSpec& joint,
                                                  const std::string& subject) {
  const bool revolute = joint.kind == JointKind::revolute;
  const XmlElement moved = element.expected(revolute ? "theta" : "d");
  const auto [dof, ratio, offset] = expected_expression(
      moved.text(), joint.kind, dofs_.size(), fmt::format("{}: {}", moved.place(), subject));
  joint.dof = dof;
  joint.ratio = ratio;
  const double other = number_or_zero(element, revolute ? "d" : "theta", subject);
  return {.theta = revolute ? offset : other, .d = revolute ? other : offset};
}

void XmlRobotReader::read_limits(const XmlElement& element, JointSpec& joint,
                                 const std::string& subject) {
  const XmlElement low = element.expected("minValue"), high = element.expected("maxValue");
  joint.min = bounded(low, subject);
  joint.max = bounded(high, subject);
  // some files write the limits for the DOF's direction although the joint moves in the opposite
  // one
  repairs_.order(joint.min, joint.max, low.place().of(subject), {"minValue", "maxValue"});
}

void XmlRobotReader::read_link(const XmlElement& element, ChainLinks& chain, ChainPlace place) {
  element.check({.attributes = {"dynamicJointType", "collisionRule", "targetChain", "targetLink"}},
                diagnostics());
  const std::string kind = element.expected_attribute("dynamicJointType");
  const int last = chain.last_joint() + errors_at(element.place().of("link {}", place.link),
                                                  [&] { return joints_of_kind(kind); });
  if (last >= chain.joints())
    element.fail("link {}: expected {} joints for the links up to it, got {}", place.link, last + 1,
                 chain.joints());
  BodySpec body = cache_.part(element.text(), path_, element.place());
  body.name = fmt::format("{}_chain{}_link{}", robot_.name, place.chain, place.link);
  chain.add_link(body, last, robot_);
  read_rule(element, place);
}

// --- pairs that never collide ---

void XmlRobotReader::read_rule(const XmlElement& link, ChainPlace place) {
  const auto rule = link.attribute("collisionRule");
  if (!rule) return;
  if (lower_case(*rule) == "off") {
    robot_.collision_rules.parts_off.push_back(static_cast<int>(robot_.links.size()) - 1);
  } else if (lower_case(*rule) == "overlappingpair") {
    ChainPlace target;
    const auto chain = link.attribute("targetChain");
    if (!chain)
      repairs_.add("target", link.place().of("link {}", place.link),
                   "OverlappingPair without a targetChain; its own chain, {}, is used",
                   place.chain);
    if (!chain || lower_case(*chain) != "base")
      target = {chain ? link.integer_attribute("targetChain", 0) : place.chain,
                link.integer_attribute("targetLink", 0)};
    pairs_off_.push_back({link, place, target});
  } else {
    repairs_.add("rule", link.place().of("link {}", place.link),
                 "collisionRule {} is neither Off nor OverlappingPair, and not used{}",
                 in_quotes(*rule), did_you_mean(*rule, {"Off", "OverlappingPair"}));
  }
}

void XmlRobotReader::read_disabled_pair(const XmlElement& element) {
  element.check({.attributes = {"body1_link", "body1_chain", "body2_link", "body2_chain"}},
                diagnostics());
  const auto place = [&](const char* chain, const char* link) {
    const ChainPlace out{element.integer_attribute(chain), element.integer_attribute(link)};
    return out.chain < 0 ? ChainPlace() : out;
  };
  const ChainPlace a = place("body1_chain", "body1_link");
  pairs_off_.push_back({element, a, place("body2_chain", "body2_link")});
}

// --- the rest ---

void XmlRobotReader::read_approach() {
  const XmlElement element = root_.child("approachDirection");
  if (!element) return;
  element.check({.once = {"referenceLocation", "direction"}}, diagnostics());
  const Eigen::Vector3d point = element.expected("referenceLocation").vector() * units::millimeter;
  const XmlElement direction = element.expected("direction");
  const Eigen::Vector3d along = direction.vector();
  robot_.X_BA = errors_at(direction, [&] { return approach_frame(point, along); });
}

void XmlRobotReader::read_tracker() {
  const XmlElement element = root_.child("flockOfBirds");
  if (!element) return;
  element.check({.once = {"transform"}, .attributes = {"number"}}, diagnostics());
  TrackerSpec tracker;
  if (const auto number = element.attribute("number"))
    tracker.number = repairs_.count(*number, element.place().of("flockOfBirds: number"));
  else
    diagnostics().note(element.place().of("flockOfBirds"), "no bird number, 0 is used");
  tracker.X_BS = read_transform_of(element, cache_.diagnostics());
  robot_.tracker = tracker;
}

NamedFile XmlRobotReader::named(const char* name) const {
  const XmlElement element = root_.child(name);
  if (!element) return {};
  element.check({}, diagnostics());
  return {element.text(), element.place().of(name)};
}

void XmlRobotReader::read_files() {
  read_robot_files(robot_, {named("eigenGrasps"), named("virtualContacts"), named("cyberGlove")},
                   path_, cache_.options());
}

}  // namespace

RobotSpec read_robot_xml(const fs::path& path, FileCache& cache) {
  const XmlFile file(path);
  const XmlElement root = file.root();
  if (root.name() != "robot") root.fail("expected a <robot>, got <{}>", excerpt(root.name()));
  return XmlRobotReader(root, path, cache).read();
}

}  // namespace clench
