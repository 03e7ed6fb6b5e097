#include "clench/io/urdf/urdf_clench.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/graspit/robot_files.h"
#include "clench/io/tree/tree_model.h"
#include "clench/io/tree/tree_xml.h"
#include "clench/spec/material_names.h"

namespace clench {

namespace {

class ClenchReader {
 public:
  ClenchReader(const XmlElement& element, RobotSpec& robot) : element_(element), robot_(robot) {}
  NamedFiles read();

 private:
  void read_child(const XmlElement& child);
  void read_dof(const XmlElement& element);
  void read_joint(const XmlElement& element);
  void read_link(const XmlElement& element);
  std::string own_material(const XmlValues& values);
  void read_collision(const XmlElement& element);
  void read_tendon(const XmlElement& element);
  void read_actuator(const XmlElement& element);
  void read_file(const XmlElement& element, NamedFile& into);
  Pose pose(const XmlValues& values) const;
  int dof(const XmlValues& values, const char* attribute) const;
  std::string joint_name(const XmlValues& values, const char* attribute) const;
  int part(const XmlValues& values, const char* attribute) const;
  BodySpec& body(int part) { return part < 0 ? robot_.base : robot_.links[part].body; }
  void once(const XmlElement& element, const std::string& what);

  const XmlElement& element_;
  RobotSpec& robot_;
  NamedFiles files_;
  std::set<std::string> seen_;
  std::map<int, std::string> dof_names_;  // those that differ from their joint's name
};

/// Fails for any other content of the element.
void expect_only(const XmlElement& element, const std::vector<std::string>& attributes,
                 bool children = false) {
  for (const auto& name : element.attributes())
    if (std::ranges::find(attributes, name) == attributes.end())
      element.fail("{}: unknown attribute {}{}", excerpt(element.name()), in_quotes(name),
                   instead_of(name, attributes));
  if (!children && !element.children().empty())
    element.fail("{}: expected no elements in it, got <{}>", excerpt(element.name()),
                 excerpt(element.children().front().name()));
  if (const auto text = element.loose_text(); !text.empty())
    element.fail("{}: expected no text in it, got {}", excerpt(element.name()), in_quotes(text));
}

double checked(const XmlValues& values, const char* name, double fallback,
               const Quantity& quantity) {
  const double x = values.number(name, fallback);
  if (const auto wrong = fault(quantity, x); !wrong.empty()) values.fail(name, "{}", wrong);
  return x;
}

/// Two numbers in ascending order; absent if the attribute is absent.
/// open  true if bounds of `unlimited` or more represent infinite ones
std::optional<std::array<double, 2>> range(const XmlValues& values, const char* name,
                                           bool open = false) {
  if (!values.has(name)) return {};
  const auto both = values.numbers(name, 2, 2);
  if (both[0] > both[1]) values.fail(name, "{} exceeds {}", both[0], both[1]);
  const auto end = [&](double x) {
    return open && std::abs(x) >= unlimited
               ? std::copysign(std::numeric_limits<double>::infinity(), x)
               : x;
  };
  return std::array{end(both[0]), end(both[1])};
}

void ClenchReader::once(const XmlElement& element, const std::string& what) {
  if (!seen_.insert(fmt::format("{} {}", element.name(), what)).second)
    element.fail("{}: expected one{}, got another", excerpt(element.name()),
                 what.empty() ? "" : " of " + in_quotes(what));
}

Pose ClenchReader::pose(const XmlValues& values) const {
  const auto q = values.numbers("quat", 4, 4);
  const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
  if (!(std::abs(turn.norm() - 1) < 1e-6))
    values.fail("quat", "expected a unit quaternion, w x y z, got ({}, {}, {}, {})", q[0], q[1],
                q[2], q[3]);
  const Pose out{turn, values.vec3("xyz", {0, 0, 0})};
  if (!is_place(out)) values.fail("xyz", "expected a position within 1e+09 m of the origin");
  return out;
}

int ClenchReader::dof(const XmlValues& values, const char* attribute) const {
  const std::string name = values.text(attribute);
  std::vector<std::string> known;
  for (const DofSpec& dof : robot_.dofs) {
    if (dof.name == name) return static_cast<int>(&dof - robot_.dofs.data());
    known.push_back(dof.name);
  }
  values.fail(attribute, "no joint {} that leads a DOF{}", in_quotes(name),
              did_you_mean(name, known));
}

std::string ClenchReader::joint_name(const XmlValues& values, const char* attribute) const {
  std::string name = values.text(attribute);
  std::vector<std::string> known;
  each_joint(robot_, [&](const JointSpec& joint) { known.push_back(joint.name); });
  if (std::ranges::find(known, name) == known.end())
    values.fail(attribute, "no joint {}{}", in_quotes(name), did_you_mean(name, known));
  return name;
}

int ClenchReader::part(const XmlValues& values, const char* attribute) const {
  const std::string name = values.text(attribute), whole = robot_.name + "_" + name;
  if (robot_.base.name == whole) return -1;
  const auto bare = [&](const BodySpec& body) {
    return body.name.substr(std::min(body.name.size(), robot_.name.size() + 1));
  };
  std::vector<std::string> known = {bare(robot_.base)};
  for (const LinkSpec& link : robot_.links) {
    if (link.body.name == whole) return static_cast<int>(&link - robot_.links.data());
    known.push_back(bare(link.body));
  }
  values.fail(attribute, "no link {}{}", in_quotes(name), did_you_mean(name, known));
}

void ClenchReader::read_dof(const XmlElement& element) {
  expect_only(element, {"joint", "name", "kind", "velocity", "kp", "kd", "damping_ratio",
                        "breakaway", "handle", "start", "driven"});
  const XmlValues values(element);
  const int number = this->dof(values, "joint");
  DofSpec& dof = robot_.dofs[number];
  once(element, dof.name);
  if (values.has("name")) dof_names_[number] = values.text("name");
  const std::string kind = values.word("kind", {"rigid", "breakaway", "compliant"}, "rigid");
  dof.kind = kind == "rigid"       ? DofKind::rigid
             : kind == "breakaway" ? DofKind::breakaway
                                   : DofKind::compliant;
  dof.default_velocity = checked(values, "velocity", 0, number_rule);
  dof.kp = checked(values, "kp", 0, number_rule);
  dof.kd = checked(values, "kd", 0, number_rule);
  dof.damping_ratio = checked(values, "damping_ratio", 0, not_negative_rule);
  dof.breakaway_torque = checked(values, "breakaway", 0, not_negative_rule);
  dof.dragger_scale = checked(values, "handle", 0, number_rule);
  dof.driven = values.boolean("driven", true);
  dof.default_value = checked(values, "start", dof.default_value, limit_rule);
}

void ClenchReader::read_joint(const XmlElement& element) {
  expect_only(element, {"name", "spring", "rest", "armature", "effort_range"});
  const XmlValues values(element);
  const std::string name = values.text("name");
  std::vector<std::string> known;
  for (LinkSpec& link : robot_.links)
    for (JointSpec& joint : link.joints) {
      known.push_back(joint.name);
      if (joint.name != name) continue;
      once(element, name);
      joint.spring = checked(values, "spring", 0, not_negative_rule);
      joint.rest = checked(values, "rest", 0, limit_rule);
      joint.armature = checked(values, "armature", 0, not_negative_rule);
      joint.effort_range = range(values, "effort_range");
      return;
    }
  values.fail("name", "no joint {}{}", in_quotes(name), did_you_mean(name, known));
}

/// The material with the friction that a <link> gives.
std::string ClenchReader::own_material(const XmlValues& values) {
  if (values.has("material"))
    values.fail("friction", "expected a material or a friction, got both");
  if (!values.has("friction")) values.fail("friction", "expected a coefficient, got none");
  const OwnFriction own{.mu = checked(values, "friction", 1, friction_rule),
                        .priority = values.integer("friction_priority", 0),
                        .frictionless = values.boolean("frictionless", false)};
  if (std::ranges::find(robot_.frictions, own) == robot_.frictions.end())
    robot_.frictions.push_back(own);
  return material_name(own);
}

void ClenchReader::read_link(const XmlElement& element) {
  expect_only(element, {"name", "material", "friction", "friction_priority", "frictionless",
                        "elastic_modulus", "soft_layer", "poisson_ratio", "restitution", "tracker",
                        "free_damping", "free_friction", "free_armature", "gravity_compensation"});
  const XmlValues values(element);
  BodySpec& body = this->body(part(values, "name"));
  once(element, body.name);
  body.material = values.text("material", body.material);
  if (values.has("material")) body.material_from = Origin::file;
  if (std::ranges::find(material_names, body.material) == material_names.end())
    values.fail("material", "unknown material {}{}", in_quotes(body.material),
                instead_of(body.material, {material_names.begin(), material_names.end()}));
  for (const char* name : {"friction", "friction_priority", "frictionless"})
    if (values.has(name)) body.material = own_material(values), body.material_from = Origin::file;
  if (values.has("elastic_modulus"))
    body.elastic_modulus = checked(values, "elastic_modulus", 0, elastic_modulus_rule);
  body.soft_layer = checked(values, "soft_layer", body.soft_layer, soft_layer_rule);
  body.poisson_ratio = checked(values, "poisson_ratio", body.poisson_ratio, poisson_ratio_rule);
  body.restitution = checked(values, "restitution", body.restitution, restitution_rule);
  body.free_damping = checked(values, "free_damping", 0, not_negative_rule);
  body.free_friction = checked(values, "free_friction", 0, not_negative_rule);
  body.free_armature = checked(values, "free_armature", 0, not_negative_rule);
  body.gravity_compensation = checked(values, "gravity_compensation", 0, number_rule);
  if (values.has("tracker")) body.tracker = values.integer("tracker", 0);
}

void ClenchReader::read_collision(const XmlElement& element) {
  expect_only(element, {"chain_links", "near_pairs"}, true);
  once(element, "");
  const XmlValues values(element);
  robot_.chain_links_collide = values.boolean("chain_links", true);
  robot_.collision_rules.near_pairs_off = !values.boolean("near_pairs", true);
  for (const XmlElement& child : element.children()) {
    const XmlValues names(child);
    if (child.name() == "never") {
      expect_only(child, {"link"});
      robot_.collision_rules.parts_off.push_back(part(names, "link"));
    } else if (child.name() == "never_pair" || child.name() == "pair") {
      expect_only(child, {"link1", "link2"});
      const int a = part(names, "link1"), b = part(names, "link2");
      if (a == b) names.fail("link2", "expected another link than link1");
      CollisionRules& rules = robot_.collision_rules;
      (child.name() == "pair" ? rules.pairs_on : rules.pairs_off).push_back({a, b});
    } else {
      child.fail("collision: expected <never>, <never_pair> or <pair>, got <{}>",
                 excerpt(child.name()));
    }
  }
}

void ClenchReader::read_tendon(const XmlElement& element) {
  expect_only(element, {"name", "range", "stiffness", "slack", "damping", "friction"}, true);
  const XmlValues values(element);
  JointTendonSpec out;
  out.name = values.text("name", "");
  out.range = range(values, "range");
  out.slack = range(values, "slack").value_or(out.slack);
  out.stiffness = checked(values, "stiffness", 0, not_negative_rule);
  out.damping = checked(values, "damping", 0, not_negative_rule);
  out.friction = checked(values, "friction", 0, not_negative_rule);
  for (const XmlElement& child : element.children()) {
    if (child.name() != "arm")
      child.fail("joint_tendon: expected <arm>, got <{}>", excerpt(child.name()));
    expect_only(child, {"joint", "length"});
    const XmlValues arm(child);
    const int number = dof(arm, "joint");
    for (const auto& [other, length] : out.arms)
      if (other == number) arm.fail("joint", "expected each joint once");
    const double length = arm.number("length");
    if (const auto wrong = fault(positive_rule, std::abs(length)); !wrong.empty())
      arm.fail("length", "{}", wrong);
    out.arms.emplace_back(number, length);
  }
  robot_.joint_tendons.push_back(std::move(out));
}

void ClenchReader::read_actuator(const XmlElement& element) {
  expect_only(element,
              {"name", "kind", "joint", "tendon", "moves", "gear", "length_at_0", "gain",
               "gain_slopes", "bias", "damping_ratio", "enabled", "control_range",
               "activation_range", "law_range", "tendon_force_range", "force_range"},
              true);
  const XmlValues values(element);
  ActuatorSpec out;
  out.name = values.text("name", "");
  out.kind = values.text("kind");
  out.joint = values.text("joint", "");
  out.tendon = values.text("tendon", "");
  if (values.has("moves")) out.dof = dof(values, "moves");
  out.gear = checked(values, "gear", 1, number_rule);
  out.law_known = values.has("gain");
  if (out.law_known) {
    out.gain = checked(values, "gain", 1, number_rule);
    const auto bias = values.numbers("bias", 3, 3);
    out.bias = {bias[0], bias[1], bias[2]};
    if (values.has("gain_slopes")) {
      const auto slopes = values.numbers("gain_slopes", 2, 2);
      out.gain_slopes = {slopes[0], slopes[1]};
    }
  }
  out.length_at_0 = checked(values, "length_at_0", 0, number_rule);
  out.damping_ratio = checked(values, "damping_ratio", 0, not_negative_rule);
  out.enabled = values.boolean("enabled", true);
  out.control_range = range(values, "control_range");
  out.activation_range = range(values, "activation_range", true);
  out.law_range = range(values, "law_range", true);
  out.tendon_force_range = range(values, "tendon_force_range");
  out.force_range = range(values, "force_range");
  for (const XmlElement& child : element.children()) {
    if (child.name() != "pull")
      child.fail("actuator: expected <pull>, got <{}>", excerpt(child.name()));
    expect_only(child, {"joint", "coefficient"});
    const XmlValues pull(child);
    out.pulls.push_back({joint_name(pull, "joint"), checked(pull, "coefficient", 1, number_rule)});
  }
  robot_.actuators.push_back(std::move(out));
}

void ClenchReader::read_file(const XmlElement& element, NamedFile& into) {
  expect_only(element, {"file"});
  once(element, "");
  into = {XmlValues(element).text("file"), element.place().of(excerpt(element.name()))};
}

void ClenchReader::read_child(const XmlElement& child) {
  const auto name = child.name();
  const XmlValues values(child);
  if (name == "dof") {
    read_dof(child);
  } else if (name == "joint") {
    read_joint(child);
  } else if (name == "link") {
    read_link(child);
  } else if (name == "collision") {
    read_collision(child);
  } else if (name == "joint_tendon") {
    read_tendon(child);
  } else if (name == "actuator") {
    read_actuator(child);
  } else if (name == "eigengrasps") {
    read_file(child, files_.eigengrasps);
  } else if (name == "virtual_contacts") {
    read_file(child, files_.virtual_contacts);
  } else if (name == "glove") {
    read_file(child, files_.glove_calibration);
  } else if (name == "approach") {
    expect_only(child, {"xyz", "quat"});
    once(child, "");
    robot_.X_BA = pose(values);
  } else if (name == "tracker") {
    expect_only(child, {"number", "xyz", "quat"});
    once(child, "");
    robot_.tracker = TrackerSpec{values.integer("number", 0), pose(values)};
  } else {
    child.fail("clench: unknown element <{}>{}", excerpt(name),
               did_you_mean(std::string(name),
                            {"dof", "joint", "link", "collision", "joint_tendon", "actuator",
                             "eigengrasps", "virtual_contacts", "glove", "approach", "tracker"}));
  }
}

NamedFiles ClenchReader::read() {
  expect_only(element_, {"class", "database_name"}, true);
  const XmlValues values(element_);
  robot_.class_name = values.text("class", robot_.class_name);
  robot_.database_name = values.text("database_name", "");
  for (const XmlElement& child : element_.children()) read_child(child);
  // DOFs have the names of their joints until all elements are read
  for (auto& [number, name] : dof_names_) robot_.dofs[number].name = std::move(name);
  std::set<std::string> names;
  for (const DofSpec& dof : robot_.dofs)
    if (!names.insert(dof.name).second)
      element_.fail("clench: two DOFs are called {}", in_quotes(dof.name));
  return std::move(files_);
}

}  // namespace

void read_clench_element(const XmlElement& element, RobotSpec& robot,
                         const std::filesystem::path& path, const FileCache& cache) {
  const NamedFiles files = ClenchReader(element, robot).read();
  read_robot_files(robot, files, path, cache.options());
}

}  // namespace clench
