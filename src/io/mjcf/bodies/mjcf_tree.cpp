#include "clench/io/mjcf/bodies/mjcf_tree.h"

#include <algorithm>
#include <cmath>

#include "clench/base/text.h"
#include "clench/io/mjcf/joints/mjcf_actuator.h"
#include "clench/io/mjcf/joints/mjcf_tendons.h"

namespace clench {

MjcfTreeReader::MjcfTreeReader(MjcfDocument& document, MjcfGeoms& geoms, const MjcfNames& names,
                               FileCache& cache, const char* whole)
    : document_(document), geoms_(geoms), cache_(cache), whole_(whole), names_(names) {}

// --- bodies in the world ---

/// Counts of joints in a body and its descendants.
struct JointCount {
  int all = 0;        // in the body and its descendants, without free joints
  bool own = false;   // true if the body itself has a joint that is not free
  bool free = false;  // true if it has a free one
};

static bool is_free(const XmlElement& element, const std::string& child_class,
                    const MjcfDocument& document) {
  if (element.name() == "freejoint") return true;
  return document.values(element, child_class).text("type", "hinge") == "free";
}

/// Joints may be inside frames, and their types may come from classes.
static void count_joints(const MjcfNode& node, const std::string& child_class,
                         const MjcfDocument& document, bool of_body, JointCount& into) {
  for (const MjcfNode& child : node.children) {
    const std::string name = child.name();
    if (name == "joint" || name == "freejoint") {
      const bool free = is_free(child.element, child_class, document);
      into.all += !free;
      if (of_body) (free ? into.free : into.own) = true;
    } else {
      const std::string inherited = child.element.attribute("childclass").value_or(child_class);
      count_joints(child, inherited, document, of_body && name == "frame", into);
    }
  }
}

bool warn_of_loss(const MjcfNode& node, MjcfDocument& document, const char* whole) {
  const std::string name = node.name();
  if (name == "composite" || name == "flexcomp") {
    document.losses().add(name, node.element.place(),
                          "<{}> is not used: the {} lacks the bodies that it generates; save the "
                          "model expanded by MuJoCo",
                          name, whole);
    return true;
  }
  document.unused().element(node.element);
  return false;
}

static void find_in_world(const MjcfNode& node, const std::string& child_class, const Pose& X_frame,
                          MjcfDocument& document, const char* whole, Worldbody& into) {
  if (node.name() == "body") {
    const auto name = node.element.attribute("name").value_or("");
    const int number = static_cast<int>(into.bodies.size());
    const std::string inherited = node.element.attribute("childclass").value_or(child_class);
    JointCount joints;
    count_joints(node, inherited, document, true, joints);
    into.order.emplace_back(true, number);
    into.bodies.push_back(
        {&node, child_class, X_frame, name.empty() ? fmt::format("body{}", number + 1) : name,
         joints.all, joints.own, joints.free, XmlValues(node.element).boolean("mocap", false)});
  } else if (node.name() == "frame") {
    const std::string inherited = node.element.attribute("childclass").value_or(child_class);
    const Pose X = X_frame * document.pose(XmlValues(node.element));
    for (const auto& child : node.children)
      find_in_world(child, inherited, X, document, whole, into);
  } else if (node.name() == "geom") {
    into.order.emplace_back(false, static_cast<int>(into.geoms.size()));
    into.geoms.push_back({&node, child_class, X_frame});
  } else if (warn_of_loss(node, document, whole)) {
    into.lacks_bodies = true;
  }
}

Worldbody read_worldbody(MjcfDocument& document, const char* whole) {
  Worldbody out;
  for (const MjcfNode* node : document.section("worldbody"))
    find_in_world(*node, "", Pose{}, document, whole, out);
  // a body without a name is named by its number, unless another body has that name
  std::map<std::string, int> names;
  for (const TopBody& body : out.bodies)
    if (body.node->element.attribute("name")) names[body.name] = 0;
  for (TopBody& body : out.bodies) {
    if (body.node->element.attribute("name").value_or("") == body.name) continue;
    if (names.contains(body.name)) body.name = unused_name(body.name, names);
    names[body.name] = 0;
  }
  return out;
}

// --- bodies ---

/// The name, or another one if an earlier element has it.
std::string MjcfTreeReader::own_name(const XmlElement& element, const std::string& name,
                                     const std::map<std::string, int>& taken) {
  if (!taken.contains(name)) return name;
  const std::string own = unused_name(name, taken);
  document_.repairs().add(std::string(element.name()), element.place().of(element.name()),
                          "there is another one of the name '{}'; it is called '{}'", excerpt(name),
                          own);
  return own;
}

int MjcfTreeReader::add_link(const XmlElement& element, const std::string& name, int parent,
                             const Pose& X_PL) {
  const int number = static_cast<int>(tree_.model.links.size());
  if (number >= max_links) element.fail("expected at most {} bodies", max_links);
  TreeLink link;
  link.parent = parent;
  link.X_PL = X_PL;
  link.body.source = document_.path().generic_string();
  if (!name.empty()) {
    link.body.name = own_name(element, name, tree_.links);
  } else {
    link.body.name = fmt::format("body{}", number);
    if (names_.has("body", link.body.name) || tree_.links.contains(link.body.name))
      link.body.name = unused_name(link.body.name, tree_.links);
  }
  tree_.links[link.body.name] = number;
  tree_.model.links.push_back(std::move(link));
  tree_.pieces.emplace_back().place = element.place();
  tree_.geoms.emplace_back();
  tree_.slots.emplace_back();
  massless_.push_back(false);
  return number;
}

void MjcfTreeReader::read_body(const MjcfNode& node, int parent, const std::string& child_class,
                               const Pose& X_frame, bool base, const std::string& name) {
  const XmlElement& element = node.element;
  document_.unused().attributes(element, {"name", "pos", "quat", "axisangle", "euler", "xyaxes",
                                          "zaxis", "childclass", "mocap", "gravcomp"});
  const XmlValues values(element);
  const std::string inherited = values.text("childclass", child_class);
  document_.check_class(element, inherited);
  const Pose X = X_frame * document_.pose(values);
  const double carried = values.number("gravcomp", 0);
  // the world places the base
  const int link = add_link(element, name, parent, base ? Pose{} : X);
  tree_.model.links[link].body.gravity_compensation = carried;
  if (base && whole_ == std::string_view("robot") && !(X == Pose{}))
    cache_.diagnostics().note(element.place(),
                              "body '{}' is the base; its pose in the file is not used",
                              excerpt(tree_.model.links[link].body.name));
  read_contents(node, link, inherited, Pose{});
  weigh(element, link);
}

void MjcfTreeReader::read_contents(const MjcfNode& node, int link, const std::string& child_class,
                                   const Pose& X_frame) {
  for (const MjcfNode& child : node.children) {
    const std::string name = child.name();
    if (name == "body") {
      read_body(child, link, child_class, X_frame, false,
                child.element.attribute("name").value_or(""));
    } else if (name == "frame") {
      const XmlValues values(child.element);
      const std::string inherited = values.text("childclass", child_class);
      document_.check_class(child.element, inherited);
      read_contents(child, link, inherited, X_frame * document_.pose(values));
    } else if (name == "joint" || name == "freejoint") {
      read_joint(child.element, link, child_class, X_frame);
    } else if (name == "inertial") {
      read_inertial(child.element, link, X_frame);
    } else if (name == "geom") {
      if (auto geom = geoms_.read(child.element, child_class, X_frame))
        tree_.geoms[link].push_back(std::move(*geom));
    } else {
      warn_of_loss(child, document_, whole_);
    }
  }
}

// --- joints ---

/// True if a range limits the joint.
static bool given_range(const XmlValues& values) {
  if (!values.has("range")) return false;
  const auto range = values.numbers("range", 2, 2);
  return range[0] != 0 || range[1] != 0 || values.text("limited", "auto") == "true";
}

void MjcfTreeReader::set_range(const XmlValues& values, TreeJoint& joint) {
  const bool turns = joint.kind == JointKind::revolute;
  const MjcfSettings& settings = document_.settings(values.element());
  const double unit = turns ? settings.angle_unit : 1;
  const std::string limited = values.word("limited", {"auto", "true", "false"}, "auto");
  // two zeros cancel the range of the class
  const bool has_range = given_range(values);
  if (limited == "auto" && has_range && !settings.autolimits)
    document_.repairs().add(
        "autolimits", values.subject("range"),
        "expected limited=\"true\" with it, as autolimits is off; the range is used");
  if (limited == "true" && !values.has("range"))
    document_.repairs().add("limited", values.subject("limited"),
                            "expected a range, got none; there are no limits");
  if (limited == "false" || !has_range) {
    const double far = turns ? endless_turn : endless_slide;
    joint.min = joint.zero - far, joint.max = joint.zero + far, joint.endless = true;
    cache_.diagnostics().note(
        joint.place,
        "joint '{}' has no limits; planners try values up to {:.4g} {} from where it is",
        excerpt(joint.name), far, turns ? "rad" : "m");
    return;
  }
  const auto range = values.range("range", document_.repairs());
  joint.min = range[0] * unit;
  joint.max = range[1] * unit;
  if (joint.min == joint.max)
    cache_.diagnostics().note(joint.place, "joint '{}' is fixed at {:.4g} {}", excerpt(joint.name),
                              joint.min, turns ? "rad" : "m");
}

void MjcfTreeReader::add_joint(TreeJoint joint, const XmlElement& element, int link) {
  if (tree_.model.joints.size() >= max_joints)
    element.fail("expected at most {} joints", max_joints);
  const int number = static_cast<int>(tree_.model.joints.size());
  joint.name = own_name(element, joint.name, tree_.joints);
  tree_.joints[joint.name] = number;
  joint.motor.default_value = std::clamp(joint.zero, joint.min, joint.max);
  tree_.model.joints.push_back(std::move(joint));
  tree_.model.links[link].joints.push_back(number);
}

/// Adds the resistance of a free joint to its body.
void MjcfTreeReader::read_free_motion(const XmlValues& values, BodySpec& body) {
  const Place subject = values.element().place().of("free joint of '{}'", excerpt(body.name));
  body.free_damping = linear_part(values, "damping", subject, document_, cache_);
  body.free_friction = values.not_negative("frictionloss", 0, document_.repairs());
  body.free_armature = values.not_negative("armature", 0, document_.repairs());
  if (linear_part(values, "stiffness", subject, document_, cache_) != 0)
    cache_.diagnostics().warn(subject,
                              "springs of free bodies are not supported; stiffness is not used");
  if (values.has("springdamper")) cache_.diagnostics().warn(subject, "springdamper is not used");
}

/// Stores stiffness and damping that depend on the inertia, until that is known.
void MjcfTreeReader::set_spring_damper(const XmlValues& values, TreeJoint& joint) {
  if (!values.has("springdamper")) return;
  const auto given = values.numbers("springdamper", 2, 2);
  if (given[0] > 0 && given[1] > 0) joint.spring_damper = std::array{given[0], given[1]};
}

void MjcfTreeReader::read_joint(const XmlElement& element, int link, const std::string& child_class,
                                const Pose& X_frame) {
  const XmlValues values = document_.values(element, child_class);
  values.tell_unused(document_.unused(),
                     {"name", "class", "type", "pos", "axis", "range", "limited", "ref",
                      "stiffness", "springref", "damping", "frictionloss", "armature",
                      "springdamper", "actuatorfrcrange", "actuatorfrclimited"});
  const std::string type = element.name() == "freejoint"
                               ? "free"
                               : values.word("type", {"hinge", "slide", "ball", "free"}, "hinge");
  TreeJoint joint;
  joint.place = element.place();
  joint.name = values.text("name", "");
  const std::string& body = tree_.model.links[link].body.name;
  if (joint.name.empty())
    joint.name = tree_.model.links[link].joints.empty()
                     ? body + "_joint"
                     : fmt::format("{}_joint{}", body, tree_.model.links[link].joints.size() + 1);
  if (type == "free") {
    tree_.slots[link].push_back({QposSlot::Kind::free});
    // the world places the base
    if (link == 0) return read_free_motion(values, tree_.model.links[link].body);
    cache_.diagnostics().warn(element.place(),
                              "joint '{}' is free; body '{}' stays where the file puts it",
                              excerpt(joint.name), excerpt(body));
    return;
  }
  joint.kind = type == "slide" ? JointKind::prismatic : JointKind::revolute;
  const double unit = type == "slide" ? 1 : document_.settings(element).angle_unit;
  joint.anchor = X_frame * values.vec3("pos", {0, 0, 0});
  const Eigen::Vector3d axis = values.vec3("axis", {0, 0, 1});
  if (!(axis.stableNorm() > 1e-9)) values.fail("axis", "expected a direction, got none");
  joint.axis = (X_frame.rotation * axis.stableNormalized()).normalized();
  const Place subject = joint.place.of("joint '{}'", excerpt(joint.name));
  joint.viscous = linear_part(values, "damping", subject, document_, cache_);
  joint.coulomb = values.not_negative("frictionloss", 0, document_.repairs());
  joint.armature = values.not_negative("armature", 0, document_.repairs());
  joint.spring = linear_part(values, "stiffness", subject, document_, cache_);
  set_spring_damper(values, joint);
  joint.effort_range = limited_range(values, document_, "actuatorfrcrange", "actuatorfrclimited");
  joint.rest = values.number("springref", 0) * unit;
  if (type != "ball") {
    joint.zero = values.number("ref", 0) * unit;
    set_range(values, joint);
    tree_.slots[link].push_back(
        {QposSlot::Kind::joint, static_cast<int>(tree_.model.joints.size())});
    add_joint(std::move(joint), element, link);
    return;
  }
  // a ball joint becomes three hinges about the body's x, y and z; its range limits the total angle
  double most = endless_turn / 2;
  if (given_range(values) && values.text("limited", "auto") != "false")
    most = std::min(most, values.numbers("range", 2, 2)[1] * unit);
  if (!(most > 0)) values.fail("range", "expected a largest angle > 0");
  cache_.diagnostics().note(joint.place,
                            "joint '{}' is a ball; it becomes three hinges of at most {:.4g} rad",
                            excerpt(joint.name), most);
  tree_.slots[link].push_back({QposSlot::Kind::ball, static_cast<int>(tree_.model.joints.size())});
  for (int i = 0; i < 3; ++i) {
    TreeJoint turn = joint;
    turn.name += fmt::format("_{}", "xyz"[i]);
    turn.axis = Eigen::Vector3d::Unit(i);
    turn.min = -most, turn.max = most, turn.rest = 0;
    add_joint(std::move(turn), element, link);
  }
}

void MjcfTreeReader::read_body(const TopBody& body, bool base) {
  if (body.free) free_.insert(static_cast<int>(tree_.model.links.size()));
  read_body(*body.node, tree_.model.links.empty() ? -1 : 0, body.child_class, body.X_frame, base,
            whole_ == std::string_view("robot") ? body.node->element.attribute("name").value_or("")
                                                : body.name);
}

}  // namespace clench
