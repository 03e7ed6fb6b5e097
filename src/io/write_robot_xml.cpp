#include <algorithm>
#include <iterator>

#include "base/units.h"
#include "io/robot_numbers.h"
#include "io/world_parts.h"
#include "io/write_robot_texts.h"
#include "io/xml.h"

namespace clench {

namespace {

std::string element(int depth, const char* name, const std::string& text) {
  return fmt::format("{:{}}<{}>{}</{}>\n", "", 2 * depth, name, xml_escaped(text), name);
}

class XmlRobotText {
 public:
  XmlRobotText(const RobotSpec& robot, RobotFolder& folder) : robot_(robot), folder_(folder) {}
  std::string text();

 private:
  std::string dof(int number) const;
  std::string chain(int number);
  std::string joint(const JointSpec& joint) const;
  std::string link(const RobotPart& part);
  const char* link_word(const RobotPart& part) const;
  std::string rules() const;
  std::string tendons() const;
  std::string wrappers() const;
  std::string named_files();
  std::string mounts() const;

  const RobotSpec& robot_;
  RobotFolder& folder_;
};

std::string XmlRobotText::dof(int number) const {
  const DofTexts t = dof_texts(robot_, number);
  std::string out = fmt::format("  <dof type=\"{}\">\n", t.kind);
  out += element(2, "defaultVelocity", t.velocity);
  if (t.value != "0") out += element(2, "defaultValue", t.value);
  out += element(2, "maxEffort", t.effort) + element(2, "Kp", t.kp) + element(2, "Kd", t.kd) +
         element(2, "draggerScale", t.scale);
  if (t.kind == "b") out += element(2, "breakAwayTorque", t.breakaway);
  return out + "  </dof>\n";
}

std::string XmlRobotText::joint(const JointSpec& joint) const {
  const JointTexts t = joint_texts(robot_, joint);
  std::string out = fmt::format("    <joint type=\"{}\">\n",
                                joint.kind == JointKind::revolute ? "Revolute" : "Prismatic");
  out += element(3, "theta", t.theta) + element(3, "d", t.d) + element(3, "a", t.a) +
         element(3, "alpha", t.alpha) + element(3, "minValue", t.min) +
         element(3, "maxValue", t.max);
  for (const auto& [name, value] : {std::pair("viscousFriction", &t.viscous),
                                    {"CoulombFriction", &t.coulomb},
                                    {"springStiffness", &t.spring},
                                    {"restValue", &t.rest}})
    if (*value != "0") out += element(3, name, *value);
  return out + "    </joint>\n";
}

/// The kind of a link says how many joints lie between it and the one before.
const char* XmlRobotText::link_word(const RobotPart& part) const {
  const ChainSpec& chain = robot_.chains[part.chain];
  const LinkSpec& link = chain.links[part.link];
  const int before = part.link > 0 ? chain.links[part.link - 1].last_joint : -1;
  const int joints = link.last_joint - before;
  constexpr const char* by_count[] = {"Fixed", "Revolute", "Universal", "Ball"};
  if (joints < 0 || joints > 3)
    fail(
        "{}: link {} of chain {} is moved by joint {} and the one before it by joint {}; .xml "
        "holds only links that follow by 0 to 3 joints, .cfg all",
        folder_.file(), part.link, part.chain, link.last_joint, before);
  constexpr LinkJoint kinds[] = {LinkJoint::fixed, LinkJoint::revolute, LinkJoint::universal,
                                 LinkJoint::ball};
  if (joints == 1 && link.joint == LinkJoint::prismatic) return "Prismatic";
  if (link.joint != kinds[joints])
    folder_.warn(
        fmt::format("{}: link {} of chain {} becomes {}, as the number of its joints has it",
                    folder_.file(), part.link, part.chain, by_count[joints]));
  return by_count[joints];
}

std::string XmlRobotText::link(const RobotPart& part) {
  const BodySpec& body = robot_.chains[part.chain].links[part.link].body;
  const bool off = std::ranges::count(robot_.collision_rules.parts_off, part) > 0;
  return fmt::format("    <link dynamicJointType=\"{}\"{}>{}</link>\n", link_word(part),
                     off ? " collisionRule=\"Off\"" : "",
                     folder_.body(body, part_name(body, robot_)));
}

std::string XmlRobotText::chain(int number) {
  const ChainSpec& chain = robot_.chains[number];
  std::string out = "  <chain>\n" + transform_element(chain.X_BC);
  for (const JointSpec& j : chain.joints) out += joint(j);
  for (int l = 0; l < static_cast<int>(chain.links.size()); ++l) out += link({number, l});
  for (const TactileSpec& sensor : robot_.tactile) {
    if (sensor.part.chain != number) continue;
    std::string corners = millimetres(sensor.low_L) + " " + millimetres(sensor.high_L);
    std::ranges::replace(corners, ' ', ',');
    out += fmt::format("    <filter params=\"{}\">{}</filter>\n", corners, sensor.part.link);
  }
  return out + "  </chain>\n";
}

std::string XmlRobotText::rules() const {
  std::string out;
  for (const auto& [a, b] : robot_.collision_rules.pairs_off)
    out += fmt::format(
        "  <disableCollision body1_chain=\"{}\" body1_link=\"{}\" "
        "body2_chain=\"{}\" body2_link=\"{}\"/>\n",
        a.chain, a.link, b.chain, b.link);
  return out;
}

std::string XmlRobotText::tendons() const {
  std::string out;
  for (const TendonSpec& tendon : robot_.tendons) {
    out += fmt::format("  <tendon name=\"{}\">\n", xml_escaped(tendon.name));
    out += element(2, "stiffness", number_in(tendon.stiffness, units::newton_per_millimetre));
    for (const auto& [name, length] : {std::pair("restLength", tendon.rest_length),
                                       {"preTensionLength", tendon.pre_tension_length}})
      if (length) out += element(2, name, number_in(*length, units::millimetre));
    for (const TendonPoint& point : tendon.points)
      out += "    <insertionPoint>\n" + element(3, "chain", std::to_string(point.part.chain)) +
             element(3, "link", std::to_string(point.part.link)) +
             element(3, "position", millimetres(point.p_L)) +
             element(3, "friction", fmt::format("{}", point.friction)) + "    </insertionPoint>\n";
    out += "  </tendon>\n";
  }
  return out;
}

std::string XmlRobotText::wrappers() const {
  std::string out;
  for (const TendonWrapper& wrapper : robot_.wrappers) {
    out += "  <tendonWrapper>\n" + element(2, "chain", std::to_string(wrapper.part.chain)) +
           element(2, "link", std::to_string(wrapper.part.link)) +
           element(2, "position", millimetres(wrapper.p_L)) +
           element(2, "orientation", words(wrapper.axis_L)) +
           element(2, "radius", number_in(wrapper.radius, units::millimetre)) +
           element(2, "length", number_in(wrapper.length, units::millimetre)) +
           element(2, "friction", fmt::format("{}", wrapper.friction));
    for (const std::string& tendon : wrapper.exempt)
      out += fmt::format("    <exemption tendon=\"{}\"/>\n", xml_escaped(tendon));
    for (const TendonWrapper::Side& side : wrapper.sides)
      out += fmt::format("    <wrapping_side tendon=\"{}\">\n", xml_escaped(side.tendon)) +
             element(3, "orientation", words(side.direction_L)) + "    </wrapping_side>\n";
    out += "  </tendonWrapper>\n";
  }
  return out;
}

std::string XmlRobotText::named_files() {
  std::string out;
  if (robot_.eigengrasps)
    out += element(1, "eigenGrasps", folder_.eigengrasps(*robot_.eigengrasps));
  if (robot_.virtual_contacts)
    out += element(1, "virtualContacts", folder_.virtual_contacts(*robot_.virtual_contacts));
  if (robot_.glove) out += element(1, "cyberGlove", folder_.glove(*robot_.glove));
  return out;
}

std::string XmlRobotText::mounts() const {
  std::string out;
  if (robot_.X_BA)
    out += "  <approachDirection>\n" +
           element(2, "referenceLocation", millimetres(robot_.X_BA->position)) +
           element(2, "direction", words(robot_.X_BA->rotation * Eigen::Vector3d::UnitZ())) +
           "  </approachDirection>\n";
  if (robot_.tracker)
    out += fmt::format("  <flockOfBirds number=\"{}\">\n", robot_.tracker->number) +
           transform_element(robot_.tracker->X_BS) + "  </flockOfBirds>\n";
  return out;
}

std::string XmlRobotText::text() {
  std::string out = "<?xml version=\"1.0\" ?>\n<robot type=\"" + xml_escaped(class_word(robot_));
  if (!robot_.database_name.empty()) out += "\" DBName=\"" + xml_escaped(robot_.database_name);
  out += "\">\n" + element(1, "palm", folder_.body(robot_.base, part_name(robot_.base, robot_)));
  for (int d = 0; d < static_cast<int>(robot_.dofs.size()); ++d) out += dof(d);
  for (int c = 0; c < static_cast<int>(robot_.chains.size()); ++c) out += chain(c);
  out += rules() + tendons() + wrappers() + mounts() + named_files();
  return out + "</robot>\n";
}

}  // namespace

std::string robot_xml_text(const RobotSpec& robot, RobotFolder& folder) {
  return XmlRobotText(robot, folder).text();
}

}  // namespace clench
