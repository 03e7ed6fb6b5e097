#include <algorithm>
#include <cmath>
#include <map>

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/io/text/find_file.h"
#include "clench/io/text/xml.h"
#include "clench/io/tree/tree_model.h"
#include "clench/io/write/robot_folder.h"
#include "clench/io/write/urdf_clench_text.h"
#include "clench/io/write/urdf_plan.h"
#include "clench/io/write/write_robot.h"
#include "clench/math/rpy.h"
#include "clench/spec/check_robot.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

/// "x y z", in the unit of v.
std::string words(const Eigen::Vector3d& v) {
  return fmt::format("{} {} {}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

class UrdfText {
 public:
  UrdfText(const RobotSpec& robot, RobotFolder& folder)
      : robot_(robot), folder_(folder), plan_(plan_urdf(robot)) {}
  std::string text();

 private:
  void add(const std::string& indent, const std::string& line) { out_ += indent + line + "\n"; }
  void add_origin(const std::string& indent, const Pose& pose);
  void add_link(const UrdfLink& link);
  void add_inertial(const UrdfLink& link);
  void add_geometry(const char* name, const UrdfLink& link, const std::string& mesh,
                    const std::string& material);
  std::string material(const Appearance& looks);
  void add_joint(const UrdfJoint& joint);
  double scale_of(int dof) const { return plan_.joints[plan_.leader_of[dof]].factor; }
  bool has_all_dofs(const char* what) const;
  void beside_eigengrasps();
  void beside_glove();
  void beside_contacts();
  void tell_moved_frames() const;

  const RobotSpec& robot_;
  RobotFolder& folder_;
  const UrdfPlan plan_;
  UrdfBeside beside_;
  std::string out_;
  std::vector<std::string> colors_;  // materials, by number
};

// --- links ---

void UrdfText::add_origin(const std::string& indent, const Pose& pose) {
  if (pose == Pose{}) return;
  add(indent, fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", words(pose.position),
                          words(rpy_of(pose.matrix()))));
}

void UrdfText::add_inertial(const UrdfLink& link) {
  const BodySpec& body = *link.body;
  // the mass that readers assign to a frame that has no mass in the file
  const bool frame = !body.shape && !body.appearance.visual && !body.com &&
                     !body.inertia_per_mass && body.mass == 1e-3;
  if (frame) return;
  const Eigen::Matrix3d I = inertia_of(body) * body.mass;
  add("    ", "<inertial>");
  Pose X_UC = Pose::translation(com_of(body));
  if (!(link.X_UB == Pose{})) X_UC = link.X_UB * X_UC;
  add_origin("      ", X_UC);
  add("      ", fmt::format("<mass value=\"{}\"/>", body.mass));
  add("      ", fmt::format("<inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" "
                            "izz=\"{}\"/>",
                            I(0, 0), I(0, 1), I(0, 2), I(1, 1), I(1, 2), I(2, 2)));
  add("    ", "</inertial>");
}

std::string UrdfText::material(const Appearance& looks) {
  if (!looks.given || !looks.triangle_colors.empty()) return "";
  const Eigen::Vector3f& c = looks.color;
  const std::string color =
      fmt::format("{} {} {} {}", within_one(c.x()), within_one(c.y()), within_one(c.z()),
                  1 - double{within_one(looks.transparency)});
  // one name per color: readers share materials by name
  const size_t number = std::ranges::find(colors_, color) - colors_.begin();
  if (number == colors_.size()) colors_.push_back(color);
  return fmt::format("<material name=\"color{}\"><color rgba=\"{}\"/></material>", number, color);
}

void UrdfText::add_geometry(const char* name, const UrdfLink& link, const std::string& mesh,
                            const std::string& material) {
  add("    ", fmt::format("<{}>", name));
  add_origin("      ", link.X_UB);
  add("      ", fmt::format("<geometry><mesh filename=\"{}\"/></geometry>", xml_escaped(mesh)));
  if (!material.empty()) add("      ", material);
  add("    ", fmt::format("</{}>", name));
}

void UrdfText::add_link(const UrdfLink& link) {
  const std::string name = fmt::format("<link name=\"{}\"", xml_escaped(link.name));
  if (!link.body) return add("  ", name + "/>");
  add("  ", name + ">");
  const BodySpec& body = *link.body;
  const Appearance& looks = body.appearance;
  const std::string part = part_name(body, robot_);
  add_inertial(link);
  std::string surface;
  if (body.shape)
    surface = folder_.mesh(body.shape->mesh(), looks.visual ? Appearance() : looks, part);
  const std::string drawn =
      looks.visual ? folder_.mesh(looks.visual->mesh(), looks, part + "_visual") : surface;
  if (!drawn.empty()) add_geometry("visual", link, drawn, material(looks));
  if (!surface.empty()) add_geometry("collision", link, surface, "");
  add("  ", "</link>");
}

// --- joints ---

void UrdfText::add_joint(const UrdfJoint& joint) {
  const char* kind = !joint.spec                                ? "fixed"
                     : joint.spec->kind == JointKind::prismatic ? "prismatic"
                     : joint.endless                            ? "continuous"
                                                                : "revolute";
  add("  ", fmt::format("<joint name=\"{}\" type=\"{}\">", xml_escaped(joint.name), kind));
  add("    ", fmt::format("<parent link=\"{}\"/>", xml_escaped(plan_.links[joint.parent].name)));
  add("    ", fmt::format("<child link=\"{}\"/>", xml_escaped(plan_.links[joint.child].name)));
  add_origin("    ", joint.X_PC);
  if (const JointSpec* spec = joint.spec) {
    const DofSpec& dof = robot_.dofs[spec->dof];
    const UrdfJoint& leader = plan_.joints[plan_.leader_of[spec->dof]];
    add("    ", fmt::format("<axis xyz=\"{}\"/>", words(joint.axis)));
    const double factor = std::abs(joint.factor);
    add("    ",
        fmt::format("<limit lower=\"{}\" upper=\"{}\" effort=\"{}\" velocity=\"{}\"/>", joint.min,
                    joint.max, dof.max_effort > 0 ? dof.max_effort / factor : unlimited,
                    dof.max_velocity > 0 ? dof.max_velocity * factor : unlimited));
    if (spec->viscous != 0 || spec->coulomb != 0)
      add("    ",
          fmt::format("<dynamics damping=\"{}\" friction=\"{}\"/>", spec->viscous, spec->coulomb));
    if (!joint.leads)
      add("    ", fmt::format("<mimic joint=\"{}\" multiplier=\"{}\"/>", xml_escaped(leader.name),
                              joint.factor / leader.factor));
  }
  add("  ", "</joint>");
}

std::string UrdfText::text() {
  for (const UrdfJoint& joint : plan_.joints)
    check_place(joint.X_PC, fmt::format("{}: joint '{}'", folder_.file(), excerpt(joint.name)));
  out_ = "<?xml version=\"1.0\"?>\n";
  add("", fmt::format("<robot name=\"{}\">", xml_escaped(plan_.name)));
  for (const UrdfLink& link : plan_.links) add_link(link);
  for (const UrdfJoint& joint : plan_.joints) add_joint(joint);
  beside_eigengrasps();
  beside_glove();
  beside_contacts();
  out_ += clench_element(robot_, plan_, beside_);
  add("", "</robot>");
  tell_moved_frames();
  for (const std::string& sentence : plan_.renamed)
    folder_.diagnostics().warn(Place(folder_.file()), "{}", sentence);
  for (const UrdfLink& link : plan_.links)
    if (!link.body)
      folder_.diagnostics().warn(Place(folder_.file()),
                                 "'{}' is a frame without mass between two joints of one link",
                                 excerpt(link.name));
  for (int d = 0; d < static_cast<int>(robot_.dofs.size()); ++d)
    if (plan_.leader_of[d] >= 0 && scale_of(d) != 1)
      folder_.diagnostics().warn(
          Place(folder_.file()),
          "the values of DOF {} are multiplied by {} in it, to equal those of its joint '{}'", d,
          scale_of(d), excerpt(plan_.joints[plan_.leader_of[d]].name));
  return out_;
}

// --- additional files ---

/// Frames of the links of a URDF are on the axes of their joints.
void UrdfText::tell_moved_frames() const {
  std::vector<std::string> moved;
  for (const UrdfLink& link : plan_.links)
    if (link.body && !(link.X_UB == Pose{})) moved.push_back(link.name);
  if (!moved.empty())
    folder_.diagnostics().warn(
        Place(folder_.file()),
        "these links have other frames in it, on the axes of their joints: {}", some_names(moved));
}

bool UrdfText::has_all_dofs(const char* what) const {
  for (const int leader : plan_.leader_of)
    if (leader < 0) {
      folder_.lost(fmt::format("{}: they count a DOF that moves no joint", what));
      return false;
    }
  return true;
}

void UrdfText::beside_eigengrasps() {
  if (!robot_.eigengrasps || !has_all_dofs("the eigengrasps")) return;
  EigengraspSet set = *robot_.eigengrasps;
  for (int d = 0; d < set.dofs; ++d) {
    if (scale_of(d) == 1) continue;
    if (!set.norm) set.norm = Eigen::VectorXd::Ones(set.dofs);
    (*set.norm)[d] *= scale_of(d);
    if (set.origin) (*set.origin)[d] *= scale_of(d);
  }
  beside_.eigengrasps = folder_.eigengrasps(set);
}

void UrdfText::beside_glove() {
  if (!robot_.glove || !has_all_dofs("the calibration of a glove")) return;
  GloveCalibration glove = *robot_.glove;
  for (int d = 0; d < static_cast<int>(robot_.dofs.size()); ++d) {
    glove.slopes.row(d) *= scale_of(d);
    glove.intercepts[d] *= scale_of(d);
  }
  beside_.glove = folder_.glove(glove);
}

/// Chains and links are numbered as by a reader of the file.
void UrdfText::beside_contacts() {
  if (!robot_.virtual_contacts) return;
  const RobotSpec outline = outline_of(plan_);
  std::map<std::string, int> links;
  for (int l = 0; l < static_cast<int>(outline.links.size()); ++l)
    links[outline.links[l].body.name] = l;
  auto contacts = *robot_.virtual_contacts;
  for (VirtualContactSpec& contact : contacts) {
    if (contact.link < 0) continue;
    const UrdfLink& link = plan_.links[plan_.link(contact.link)];
    contact.link = links.at(link.name);
    if (!(link.X_UB == Pose{})) contact.X_LC = link.X_UB * contact.X_LC;
  }
  const auto set = contact_set(robot_.name, chains_of(outline), std::move(contacts));
  beside_.virtual_contacts = folder_.virtual_contacts(set);
}

/// Reports properties that a URDF cannot hold.
void report_losses(const RobotSpec& robot, const RobotFolder& folder) {
  std::vector<char> moves(robot.dofs.size());
  each_joint(robot, [&](const JointSpec& joint) { moves[joint.dof] = true; });
  for (size_t d = 0; d < moves.size(); ++d)
    if (!moves[d]) folder.lost(fmt::format("DOF {}, which moves no joint", d));
  if (!robot.tactile.empty())
    folder.lost(fmt::format("the {} tactile sensors", robot.tactile.size()));
  if (!robot.tendons.empty() || !robot.wrappers.empty())
    folder.lost(
        fmt::format("the {} tendons and {} wrappers", robot.tendons.size(), robot.wrappers.size()));
}

/// Products of valid numbers may be invalid, infinite for example.
void check_writable(const RobotSpec& robot, const std::string& file) {
  try {
    check_robot(robot);
  } catch (const Error& error) {
    fail(error.kind(), "{} cannot be written: {}", file, error.what());
  }
}

}  // namespace

void write_robot(const RobotSpec& robot, const fs::path& path, const WriteOptions& options) {
  const std::string ending = lower_case(path.extension().string());
  const std::string file = path.filename().string();
  if (ending != ".urdf") fail("{}: expected a robot to .urdf, got {}", file, in_quotes(ending));
  check_folder_of(path);
  std::error_code code;
  if (fs::is_directory(path, code))
    fail("{}: expected a file to write, got a folder", path.generic_string());
  check_writable(robot, file);
  RobotFolder folder(path, options);
  UrdfText urdf(robot, folder);
  const std::string text = urdf.text();
  report_losses(robot, folder);
  folder.write(text);
}

}  // namespace clench
