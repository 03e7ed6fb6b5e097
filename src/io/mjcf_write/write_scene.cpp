#include "clench/io/mjcf_write/write_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "clench/base/text.h"
#include "clench/io/mjcf/document/solver_settings.h"
#include "clench/io/mjcf_write/written_actuators.h"
#include "clench/io/mjcf_write/written_carriage.h"
#include "clench/io/mjcf_write/written_friction.h"
#include "clench/io/mjcf_write/written_geoms.h"
#include "clench/io/mjcf_write/written_keys.h"
#include "clench/io/text/xml.h"
#include "clench/math/decompositions.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace {

std::string triple(const Eigen::Vector3d& v) {
  return fmt::format("{} {} {}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

std::string range_text(const std::array<double, 2>& range) {
  return fmt::format("{} {}", range[0] + 0.0, range[1] + 0.0);
}

std::string placed_at(const Pose& X) {
  const Eigen::Quaterniond& q = X.rotation;
  std::string out;
  if (!X.position.isZero(0)) out += fmt::format(" pos=\"{}\"", triple(X.position));
  if (!(q.w() == 1 && q.vec().isZero(0)))
    out += fmt::format(" quat=\"{} {} {} {}\"", q.w(), q.x(), q.y(), q.z());
  return out;
}

/// name="value", unless the value is 0.
std::string unless_zero(const char* name, double value) {
  return value == 0 ? "" : fmt::format(" {}=\"{}\"", name, value);
}

std::string named_as(const char* attribute, const std::string& name) {
  return fmt::format(" {}=\"{}\"", attribute, xml_escaped(name));
}

std::string number_words(const std::vector<double>& numbers) {
  std::string out;
  for (const double x : numbers) out += fmt::format("{}{}", out.empty() ? "" : " ", x + 0.0);
  return out;
}

// MuJoCo rejects an inertia whose largest moment exceeds the sum of the others even by rounding
Eigen::Matrix3d checked_by_mujoco(const Eigen::Matrix3d& per_mass) {
  constexpr double slack = 1e-9;
  const Eigen::Matrix3d even = 0.5 * (per_mass + per_mass.transpose());
  auto [moments, axes] = eigensystem(even);
  const double missing = 0.5 * ((1 + slack) * moments[2] - moments[0] - moments[1]);
  if (missing <= 0) return even;
  moments[0] += missing;
  moments[1] += missing;
  const Eigen::Matrix3d out = axes * moments.asDiagonal() * axes.transpose();
  return 0.5 * (out + out.transpose());
}

constexpr double usual_threshold = 1e-4;  // of contacts in an empty world [m]

class SceneWriter {
 public:
  SceneWriter(const SceneRequest& request, const std::string& folder)
      : request_(request),
        scene_(plan_scene(request)),
        drives_(plan_drives(request, scene_)),
        contacts_(plan_contacts(request, scene_)),
        carriage_(plan_carriage(request, scene_)),
        geoms_(folder) {
    for (const WrittenBody& body : scene_.bodies) geoms_.add(body);
  }
  MjcfFiles write();

 private:
  void line(int depth, const std::string& text) {
    out_.append(static_cast<size_t>(2 * depth), ' ');
    out_ += text + '\n';
  }
  void write_head();
  void write_assets();
  void write_body(int number, int depth);
  void write_inertial(const WrittenBody& body, int depth);
  void write_joints(const WrittenBody& body, int depth);
  void write_geom(const WrittenBody& body, const WrittenGeom& geom, int depth);
  std::string surface_of(const WrittenBody& body) const;
  void write_contacts();
  void write_couplings();
  void write_tendons();
  void write_actuators();
  void write_keys();
  void tell_losses(MjcfFiles& out) const;

  const SceneRequest& request_;
  const WrittenScene scene_;
  const WrittenDrives drives_;
  const WrittenContacts contacts_;
  const Carriage carriage_;
  SceneGeoms geoms_;
  std::string out_;
};

// --- bodies ---

void SceneWriter::write_head() {
  const WorldSpec& world = request_.world;
  const Eigen::Vector3d gravity = world.gravity.value_or(Eigen::Vector3d(0, 0, -standard_gravity));
  const bool collides = world.collision ? world.collision->on : world.collision_on;
  line(0, fmt::format("<mujoco{}>", named_as("model", request_.name)));
  line(1, "<compiler angle=\"radian\" inertiafromgeom=\"false\"/>");
  line(1, fmt::format("<option timestep=\"{}\" gravity=\"{}\" cone=\"{}\" impratio=\"{}\" "
                      "integrator=\"{}\">",
                      request_.time_step, triple(gravity), written_cone, written_impratio,
                      written_integrator));
  line(2, fmt::format("<flag multiccd=\"enable\"{}/>", collides ? "" : " contact=\"disable\""));
  line(1, "</option>");
  line(1, "<size njmax=\"4000\" nconmax=\"1000\"/>");
  // the contact threshold is that of the world; contacts are as stiff as the time step allows
  const std::string stiff = fmt::format("margin=\"{}\" solref=\"{}\" solimp=\"{}\"",
                                        world.contact_threshold.value_or(usual_threshold),
                                        written_solref(request_.time_step), written_solimp);
  line(1, "<default>");
  line(2, fmt::format("<geom {}/>", stiff));
  line(2, fmt::format("<pair {}/>", stiff));
  // rigid couplings: with MuJoCo's default impedance light fingers yield, and pads touch at one end
  line(2, fmt::format("<equality solref=\"{} 1\" solimp=\"0.999 0.9999 0.001\"/>",
                      2 * request_.time_step));
  line(1, "</default>");
}

void SceneWriter::write_assets() {
  if (geoms_.meshes().empty()) return;
  line(1, "<asset>");
  for (const WrittenMesh& mesh : geoms_.meshes())
    line(2, fmt::format("<mesh{}{}/>", named_as("name", mesh.name), named_as("file", mesh.file)));
  line(1, "</asset>");
}

void SceneWriter::write_inertial(const WrittenBody& body, int depth) {
  const BodySpec& spec = *body.spec;
  const Eigen::Matrix3d I = checked_by_mujoco(inertia_of(spec)) * spec.mass;
  line(depth, fmt::format("<inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{} {} {} {} {} {}\"/>",
                          triple(com_of(spec)), spec.mass, I(0, 0), I(1, 1), I(2, 2), I(0, 1),
                          I(0, 2), I(1, 2)));
}

void SceneWriter::write_joints(const WrittenBody& body, int depth) {
  const BodySpec& spec = *body.spec;
  if (body.free)
    line(depth, fmt::format("<joint{} type=\"free\"{}{}{}/>", named_as("name", body.name + "_free"),
                            unless_zero("damping", spec.free_damping),
                            unless_zero("frictionloss", spec.free_friction),
                            unless_zero("armature", spec.free_armature)));
  if (body.carried)
    for (const CarriageAxis& axis : carriage_.axes)
      line(depth, fmt::format("<joint{} type=\"{}\" axis=\"{}\"/>", named_as("name", axis.name),
                              axis.turns ? "hinge" : "slide", triple(axis.axis_B)));
  for (const WrittenJoint& joint : body.joints) {
    const JointSpec& from = *joint.spec;
    std::string text =
        fmt::format("<joint{} type=\"{}\" axis=\"{}\"", named_as("name", joint.name),
                    from.kind == JointKind::prismatic ? "slide" : "hinge", triple(joint.axis));
    if (!joint.anchor.isZero(0)) text += fmt::format(" pos=\"{}\"", triple(joint.anchor));
    text += unless_zero("ref", joint.coordinate(joint.value));
    if (from.endless)
      text += " limited=\"false\"";
    else
      text += fmt::format(" limited=\"true\" range=\"{}\"",
                          range_text({joint.coordinate(from.min), joint.coordinate(from.max)}));
    text += unless_zero("damping", from.viscous) + unless_zero("frictionloss", from.coulomb) +
            unless_zero("armature", from.armature) + unless_zero("stiffness", from.spring);
    if (from.spring != 0) text += fmt::format(" springref=\"{}\"", joint.coordinate(from.rest));
    line(depth, text + "/>");
  }
}

std::string SceneWriter::surface_of(const WrittenBody& body) const {
  const double mu = contacts_.friction.at(body.spec->material);
  // torsional friction of patches becomes that of MuJoCo's contact points
  if (body.spec->elastic_modulus && request_.torsion_radius > 0)
    return fmt::format(" condim=\"4\" friction=\"{} {} 0.0001\"", mu, mu * request_.torsion_radius);
  return fmt::format(" friction=\"{} 0.005 0.0001\"", mu);
}

void SceneWriter::write_geom(const WrittenBody& body, const WrittenGeom& geom, int depth) {
  const Appearance& looks = body.spec->appearance;
  std::string text = fmt::format("<geom{} type=\"{}\"", named_as("name", geom.name), geom.type);
  if (geom.mesh >= 0)
    text += named_as("mesh", geoms_.meshes()[static_cast<size_t>(geom.mesh)].name);
  else
    text += fmt::format(" size=\"{}\"{}", geom.size, placed_at(geom.X_BG));
  const auto& bits = contacts_.bits[static_cast<size_t>(&body - scene_.bodies.data())];
  if (!geom.collides)
    text += " contype=\"0\" conaffinity=\"0\" group=\"2\"";
  else if (bits != std::array<unsigned, 2>{1, 1})
    text += fmt::format(" contype=\"{}\" conaffinity=\"{}\"", static_cast<int>(bits[0]),
                        static_cast<int>(bits[1]));
  if (geom.collides) text += surface_of(body) + (looks.visual ? " group=\"3\"" : "");
  const Eigen::Vector3f c = looks.color.cwiseMax(0.f).cwiseMin(1.f);
  text += fmt::format(" rgba=\"{} {} {} {}\"", c.x(), c.y(), c.z(),
                      1 - double{std::clamp(looks.transparency, 0.f, 1.f)});
  line(depth, text + "/>");
}

void SceneWriter::write_body(int number, int depth) {
  const auto n = static_cast<size_t>(number);
  const WrittenBody& body = scene_.bodies[n];
  const Pose X_PB =
      body.parent < 0 ? body.X_WB
                      : scene_.bodies[static_cast<size_t>(body.parent)].X_WB.inverse() * body.X_WB;
  line(depth, fmt::format("<body{}{}>", named_as("name", body.name), placed_at(X_PB)));
  write_inertial(body, depth + 1);
  write_joints(body, depth + 1);
  for (const WrittenGeom& geom : geoms_.geoms()[n]) write_geom(body, geom, depth + 1);
  for (const int child : body.children) write_body(child, depth + 1);
  line(depth, "</body>");
}

// --- contacts, couplings, tendons and actuators ---

void SceneWriter::write_contacts() {
  if (contacts_.pairs.empty() && contacts_.excluded.empty()) return;
  line(1, "<contact>");
  for (const auto& [a, b] : contacts_.excluded)
    line(2, fmt::format("<exclude{}{}/>",
                        named_as("body1", scene_.bodies[static_cast<size_t>(a)].name),
                        named_as("body2", scene_.bodies[static_cast<size_t>(b)].name)));
  for (const FrictionPair& pair : contacts_.pairs)
    for (const WrittenGeom& one : geoms_.geoms()[static_cast<size_t>(pair.a)])
      for (const WrittenGeom& other : geoms_.geoms()[static_cast<size_t>(pair.b)])
        if (one.collides && other.collides)
          line(2, fmt::format("<pair{}{} friction=\"{} {} 0.005 0.0001 0.0001\"/>",
                              named_as("geom1", one.name), named_as("geom2", other.name), pair.mu,
                              pair.mu));
  line(1, "</contact>");
}

void SceneWriter::write_couplings() {
  std::string text;
  for (int r = 0; r < static_cast<int>(request_.world.robots.size()); ++r) {
    const RobotSpec& robot = request_.world.robots[static_cast<size_t>(r)].robot;
    for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) {
      // joints with springs have servos instead of equalities
      if (robot.dofs[static_cast<size_t>(d)].kind == DofKind::compliant) continue;
      const auto joints = joints_of_dof(scene_, r, d);
      for (size_t j = 1; j < joints.size(); ++j) {
        const double lead = joints[0].joint->spec->ratio;
        if (lead == 0) continue;
        text += fmt::format(
            "    <joint{}{} polycoef=\"0 {} 0 0 0\"/>\n", named_as("joint1", joints[j].joint->name),
            named_as("joint2", joints[0].joint->name), joints[j].joint->spec->ratio / lead);
      }
    }
  }
  if (!text.empty()) out_ += "  <equality>\n" + text + "  </equality>\n";
}

void SceneWriter::write_tendons() {
  if (drives_.tendons.empty()) return;
  line(1, "<tendon>");
  for (const WrittenTendon& tendon : drives_.tendons) {
    std::string text = fmt::format("<fixed{}", named_as("name", tendon.name));
    if (const JointTendonSpec* from = tendon.spec) {
      const double s = tendon.shift;
      if (from->range)
        text += fmt::format(" limited=\"true\" range=\"{}\"",
                            range_text({(*from->range)[0] + s, (*from->range)[1] + s}));
      text += unless_zero("stiffness", from->stiffness) + unless_zero("damping", from->damping) +
              unless_zero("frictionloss", from->friction);
      if (from->stiffness != 0)
        text += fmt::format(" springlength=\"{}\"",
                            range_text({from->slack[0] + s, from->slack[1] + s}));
    }
    line(2, text + ">");
    for (const auto& [joint, coefficient] : tendon.joints)
      line(3, fmt::format("<joint{} coef=\"{}\"/>", named_as("joint", joint), coefficient));
    line(2, "</fixed>");
  }
  line(1, "</tendon>");
}

void SceneWriter::write_actuators() {
  if (drives_.actuators.empty() && carriage_.axes.empty()) return;
  line(1, "<actuator>");
  const auto write = [&](const WrittenActuator& a) {
    const bool affine = a.gain_slopes != std::array<double, 2>{0, 0};
    std::string text = fmt::format("<general{}", named_as("name", a.name));
    text += a.tendon.empty() ? named_as("joint", a.joint) : named_as("tendon", a.tendon);
    if (a.gear != 1) text += fmt::format(" gear=\"{}\"", a.gear);
    text += affine ? fmt::format(" gaintype=\"affine\" gainprm=\"{} {} {}\"", a.gain,
                                 a.gain_slopes[0], a.gain_slopes[1])
                   : fmt::format(" gainprm=\"{}\"", a.gain);
    if (a.bias != std::array<double, 3>{0, 0, 0} || a.hold != 0)
      text += fmt::format(" biastype=\"affine\" biasprm=\"{} {} {}\"", a.bias[0] + a.hold + 0.0,
                          a.bias[1], a.bias[2]);
    if (a.control_range)
      text += fmt::format(" ctrllimited=\"true\" ctrlrange=\"{}\"", range_text(*a.control_range));
    if (a.force_range)
      text += fmt::format(" forcelimited=\"true\" forcerange=\"{}\"", range_text(*a.force_range));
    line(2, text + "/>");
  };
  for (const CarriageAxis& axis : carriage_.axes) {
    WrittenActuator a;
    a.name = a.joint = axis.name;
    a.gain = axis.kp;
    a.bias = {0, -axis.kp, -axis.kd};
    a.hold = axis.hold;
    write(a);
  }
  for (const WrittenActuator& a : drives_.actuators) write(a);
  line(1, "</actuator>");
}

// --- keys ---

void SceneWriter::write_keys() {
  if (request_.keys.empty()) return;
  line(1, "<keyframe>");
  for (const WrittenKey& key : request_.keys) {
    const auto q = positions_of(key, scene_, carriage_),
               control = controls_of(key, request_, drives_, carriage_);
    line(2, fmt::format("<key{}{}{}/>", named_as("name", key.name),
                        q.empty() ? "" : fmt::format(" qpos=\"{}\"", number_words(q)),
                        control.empty() ? "" : fmt::format(" ctrl=\"{}\"", number_words(control))));
  }
  line(1, "</keyframe>");
}

// --- all ---

std::string obj_lines(const Mesh& mesh) {
  std::string out = "# meters\n";
  for (const auto& p : mesh.vertices)
    fmt::format_to(std::back_inserter(out), "v {} {} {}\n", p.x(), p.y(), p.z());
  for (const Triangle& t : mesh.triangles)
    fmt::format_to(std::back_inserter(out), "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return out;
}

void SceneWriter::tell_losses(MjcfFiles& out) const {
  out.losses = geoms_.losses();
  std::vector<std::string> names;
  for (const auto* list : {&drives_.losses, &contacts_.losses})
    names.insert(names.end(), list->begin(), list->end());
  for (const PlacedRobot& placed : request_.world.robots) {
    const RobotSpec& robot = placed.robot;
    const auto breaks = [](const DofSpec& dof) { return dof.kind == DofKind::breakaway; };
    if (std::ranges::any_of(robot.dofs, breaks))
      names.push_back(fmt::format("joints of '{}' that break away", excerpt(robot.name)));
    bool limits = false;
    each_joint(robot, [&](const JointSpec& joint) { limits = limits || joint.effort_range; });
    if (limits)
      names.push_back(
          fmt::format("limits of the sum of efforts on joints of '{}'", excerpt(robot.name)));
  }
  std::vector<std::string> lighter, colored, textured;
  for (const WrittenBody& body : scene_.bodies) {
    if (body.spec->gravity_compensation != 0) lighter.push_back(body.name);
    if (!body.spec->appearance.triangle_colors.empty() && body.spec->appearance.given)
      colored.push_back(body.name);
    if (body.spec->appearance.skin) textured.push_back(body.name);
  }
  if (!lighter.empty()) names.push_back("the gravity compensation of " + some_names(lighter));
  if (!colored.empty()) names.push_back("the colors of single triangles of " + some_names(colored));
  if (!textured.empty()) names.push_back("the textures of " + some_names(textured));
  for (const WrittenKey& key : request_.keys)
    if (const auto still = unmoved_in(key, scene_); !still.empty())
      names.push_back(fmt::format("the poses in key '{}' of fixed bodies: {}", excerpt(key.name),
                                  name_list(still)));
  for (const std::string& name : names) out.losses.push_back("it does not hold " + name);
}

MjcfFiles SceneWriter::write() {
  write_head();
  write_assets();
  line(1, "<worldbody>");
  for (const int root : scene_.roots) write_body(root, 2);
  line(1, "</worldbody>");
  write_contacts();
  write_couplings();
  write_tendons();
  write_actuators();
  write_keys();
  line(0, "</mujoco>");
  MjcfFiles out;
  out.text = std::move(out_);
  for (const WrittenMesh& mesh : geoms_.meshes()) out.files[mesh.file] = obj_lines(mesh.mesh);
  tell_losses(out);
  return out;
}

}  // namespace

MjcfFiles mjcf_scene(const SceneRequest& request, const std::string& folder) {
  return SceneWriter(request, folder).write();
}

}  // namespace clench
