#include "clench/io/write/urdf_clench_text.h"

#include <algorithm>
#include <cmath>

#include "clench/base/text.h"
#include "clench/io/text/xml.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

namespace {

class ClenchText {
 public:
  ClenchText(const RobotSpec& robot, const UrdfPlan& plan) : robot_(robot), plan_(plan) {}
  std::string text(const UrdfBeside& beside);

 private:
  std::string attribute(const char* name, const std::string& value) const {
    return fmt::format(" {}=\"{}\"", name, xml_escaped(value));
  }
  std::string attribute(const char* name, double value) const {
    return fmt::format(" {}=\"{}\"", name, value + 0.0);
  }
  /// defaults are left out
  std::string unless(double usual, const char* name, double value) const {
    return value == usual ? "" : attribute(name, value);
  }
  /// an infinite bound becomes `unlimited`
  static std::string range(const char* name, const std::array<double, 2>& bounds) {
    const auto end = [](double x) {
      return (std::isinf(x) ? std::copysign(unlimited, x) : x) + 0.0;
    };
    return fmt::format(" {}=\"{} {}\"", name, end(bounds[0]), end(bounds[1]));
  }
  /// -1 for a leader that turns against its DOF: in the file its axis is reversed
  static double sense(const UrdfJoint& joint) {
    return joint.leads && joint.spec->ratio < 0 ? -1 : 1;
  }
  const UrdfJoint* joint(const std::string& name) const;
  std::string pose(const Pose& X) const;
  std::string link_name(int part) const { return plan_.links[plan_.link(part)].name; }
  void add_dof(int number);
  void add_joint(const UrdfJoint& joint);
  void add_link(const UrdfLink& link);
  void add_collision();
  std::string material(const BodySpec& body) const;
  void add_tendon(const JointTendonSpec& tendon);
  void add_actuator(const ActuatorSpec& actuator);
  void line(const std::string& text) { out_ += "    " + text + "\n"; }

  const RobotSpec& robot_;
  const UrdfPlan& plan_;
  std::string out_;
};

std::string ClenchText::pose(const Pose& X) const {
  const auto& p = X.position;
  const auto& q = X.rotation;
  return fmt::format(" xyz=\"{} {} {}\" quat=\"{} {} {} {}\"", p.x(), p.y(), p.z(), q.w(), q.x(),
                     q.y(), q.z());
}

/// Values of the DOF are multiplied by `scale` in the file, and forces divided by it.
void ClenchText::add_dof(int number) {
  if (plan_.leader_of[number] < 0) return;
  const DofSpec& dof = robot_.dofs[number];
  const UrdfJoint& leader = plan_.joints[plan_.leader_of[number]];
  const double scale = leader.factor;
  constexpr const char* kinds[] = {"rigid", "breakaway", "compliant"};
  // grasps identify DOFs by name; a DOF whose values differ in the file gets another name
  const std::string name = dof.name.empty() ? fmt::format("dof{}", number + 1) : dof.name;
  line("<dof" + attribute("joint", leader.name) +
       (name == leader.name || std::abs(scale - 1) > 1e-12 ? "" : attribute("name", name)) +
       attribute("kind", std::string(kinds[static_cast<int>(dof.kind)])) +
       attribute("velocity", dof.default_velocity * scale) +
       unless(0, "kp", dof.kp / scale / scale) + unless(0, "kd", dof.kd / scale / scale) +
       unless(0, "damping_ratio", dof.damping_ratio) +
       unless(0, "breakaway", dof.breakaway_torque / scale) +
       unless(0, "handle", dof.dragger_scale) + attribute("start", dof.default_value * scale) +
       (dof.driven ? "" : attribute("driven", std::string("false"))) + "/>");
}

void ClenchText::add_joint(const UrdfJoint& joint) {
  if (!joint.spec) return;
  const JointSpec& spec = *joint.spec;
  if (spec.spring == 0 && spec.rest == 0 && spec.armature == 0 && !spec.effort_range) return;
  const double turned = sense(joint);
  std::string efforts;
  if (spec.effort_range) {
    auto [low, high] = *spec.effort_range;
    if (turned < 0) std::swap(low *= -1, high *= -1);
    efforts = range("effort_range", {low, high});
  }
  line("<joint" + attribute("name", joint.name) + unless(0, "spring", spec.spring) +
       unless(0, "rest", turned * spec.rest) + unless(0, "armature", spec.armature) + efforts +
       "/>");
}

std::string ClenchText::material(const BodySpec& body) const {
  if (body.material == "plastic") return "";
  for (const OwnFriction& own : robot_.frictions)
    if (body.material == material_name(own))
      return attribute("friction", own.mu) +
             (own.priority == 0 ? "" : fmt::format(" friction_priority=\"{}\"", own.priority)) +
             (own.frictionless ? " frictionless=\"true\"" : "");
  return attribute("material", body.material);
}

void ClenchText::add_link(const UrdfLink& link) {
  if (!link.body) return;
  const BodySpec& body = *link.body;
  const BodySpec plain;
  std::string out;
  out += material(body);
  if (body.elastic_modulus) out += attribute("elastic_modulus", *body.elastic_modulus);
  out += unless(plain.soft_layer, "soft_layer", body.soft_layer);
  out += unless(plain.poisson_ratio, "poisson_ratio", body.poisson_ratio);
  out += unless(plain.restitution, "restitution", body.restitution);
  out += unless(0, "free_damping", body.free_damping);
  out += unless(0, "free_friction", body.free_friction);
  out += unless(0, "free_armature", body.free_armature);
  out += unless(0, "gravity_compensation", body.gravity_compensation);
  if (body.tracker) out += fmt::format(" tracker=\"{}\"", *body.tracker);
  if (!out.empty()) line("<link" + attribute("name", link.name) + out + "/>");
}

void ClenchText::add_collision() {
  const CollisionRules& rules = robot_.collision_rules;
  std::string inside;
  const auto pair = [&](int a, int b) {
    inside += "      <never_pair" + attribute("link1", link_name(a)) +
              attribute("link2", link_name(b)) + "/>\n";
  };
  for (const int part : rules.parts_off)
    inside += "      <never" + attribute("link", link_name(part)) + "/>\n";
  for (const auto& [a, b] : rules.pairs_off) pair(a, b);
  for (const auto& [a, b] : rules.pairs_on)
    inside += "      <pair" + attribute("link1", link_name(a)) + attribute("link2", link_name(b)) +
              "/>\n";
  // in the file a link that is moved by two joints is not adjacent to the base
  for (size_t l = 0; l < robot_.links.size(); ++l)
    if (!robot_.chain_links_collide && robot_.links[l].parent < 0 &&
        robot_.links[l].joints.size() > 1)
      pair(-1, static_cast<int>(l));
  std::string flags;
  if (!robot_.chain_links_collide) flags += " chain_links=\"false\"";
  if (rules.near_pairs_off) flags += " near_pairs=\"false\"";
  if (inside.empty() && flags.empty()) return;
  line("<collision" + flags + (inside.empty() ? "/>" : ">"));
  if (!inside.empty()) out_ += inside + "    </collision>\n";
}

/// Arms are lengths per unit of the DOF in the file.
void ClenchText::add_tendon(const JointTendonSpec& tendon) {
  std::string out;
  if (!tendon.name.empty()) out += attribute("name", tendon.name);
  if (tendon.range) out += range("range", *tendon.range);
  out += unless(0, "stiffness", tendon.stiffness);
  if (tendon.stiffness != 0) out += range("slack", tendon.slack);
  out += unless(0, "damping", tendon.damping) + unless(0, "friction", tendon.friction);
  line("<joint_tendon" + out + ">");
  for (const auto& [dof, arm] : tendon.arms) {
    const int leader = plan_.leader_of[dof];
    if (leader < 0) continue;
    const UrdfJoint& joint = plan_.joints[leader];
    line("  <arm" + attribute("joint", joint.name) + attribute("length", arm / joint.factor) +
         "/>");
  }
  line("</joint_tendon>");
}

/// The joint of the file that represents a joint of the robot; null if the file lacks it.
const UrdfJoint* ClenchText::joint(const std::string& name) const {
  for (const UrdfJoint& joint : plan_.joints)
    if (joint.spec && joint.spec->name == name) return &joint;
  return nullptr;
}

void ClenchText::add_actuator(const ActuatorSpec& actuator) {
  std::string out;
  double turned = 1;
  if (!actuator.name.empty()) out += attribute("name", actuator.name);
  out += attribute("kind", actuator.kind);
  if (!actuator.joint.empty()) {
    const UrdfJoint* joint = this->joint(actuator.joint);
    if (joint) turned = sense(*joint);
    out += attribute("joint", joint ? joint->name : actuator.joint);
  }
  if (!actuator.tendon.empty()) out += attribute("tendon", actuator.tendon);
  if (actuator.dof >= 0 && plan_.leader_of[actuator.dof] >= 0)
    out += attribute("moves", plan_.joints[plan_.leader_of[actuator.dof]].name);
  out += attribute("gear", turned * actuator.gear) + unless(0, "length_at_0", actuator.length_at_0);
  if (actuator.law_known) {
    out += attribute("gain", actuator.gain);
    if (actuator.gain_slopes != std::array{0.0, 0.0})
      out += range("gain_slopes", actuator.gain_slopes);
    out += fmt::format(" bias=\"{} {} {}\"", actuator.bias[0], actuator.bias[1], actuator.bias[2]);
  }
  out += unless(0, "damping_ratio", actuator.damping_ratio);
  if (!actuator.enabled) out += attribute("enabled", std::string("false"));
  const std::pair<const char*, const std::optional<std::array<double, 2>>*> ranges[] = {
      {"control_range", &actuator.control_range},
      {"activation_range", &actuator.activation_range},
      {"law_range", &actuator.law_range},
      {"tendon_force_range", &actuator.tendon_force_range},
      {"force_range", &actuator.force_range}};
  for (const auto& [name, bounds] : ranges)
    if (*bounds) out += range(name, **bounds);
  if (actuator.pulls.empty()) return line("<actuator" + out + "/>");
  line("<actuator" + out + ">");
  for (const TendonPull& pull : actuator.pulls) {
    const UrdfJoint* joint = this->joint(pull.joint);
    line("  <pull" + attribute("joint", joint ? joint->name : pull.joint) +
         attribute("coefficient", (joint ? sense(*joint) : 1) * pull.coefficient) + "/>");
  }
  line("</actuator>");
}

std::string ClenchText::text(const UrdfBeside& beside) {
  // written even if absent: worlds then use the frame of the base
  line("<approach" + pose(robot_.X_BA.value_or(Pose{})) + "/>");
  if (robot_.tracker)
    line(fmt::format("<tracker number=\"{}\"{}/>", robot_.tracker->number,
                     pose(robot_.tracker->X_BS)));
  for (int d = 0; d < static_cast<int>(robot_.dofs.size()); ++d) add_dof(d);
  for (const UrdfJoint& joint : plan_.joints) add_joint(joint);
  for (const UrdfLink& link : plan_.links) add_link(link);
  add_collision();
  for (const JointTendonSpec& tendon : robot_.joint_tendons) add_tendon(tendon);
  for (const ActuatorSpec& actuator : robot_.actuators) add_actuator(actuator);
  const auto file = [&](const char* element, const std::string& name) {
    if (!name.empty()) line(fmt::format("<{}", element) + attribute("file", name) + "/>");
  };
  file("eigengrasps", beside.eigengrasps);
  file("virtual_contacts", beside.virtual_contacts);
  file("glove", beside.glove);
  std::string head = "  <clench";
  if (!robot_.class_name.empty() && robot_.class_name != plan_.name)
    head += attribute("class", robot_.class_name);
  if (!robot_.database_name.empty()) head += attribute("database_name", robot_.database_name);
  return head + ">\n" + out_ + "  </clench>\n";
}

}  // namespace

std::string clench_element(const RobotSpec& robot, const UrdfPlan& plan, const UrdfBeside& beside) {
  return ClenchText(robot, plan).text(beside);
}

}  // namespace clench
