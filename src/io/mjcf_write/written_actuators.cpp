#include "clench/io/mjcf_write/written_actuators.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clench/base/text.h"

namespace clench {

namespace {

constexpr double servo_frequency = 60;  // for motors without gains, as in dynamics [rad/s]

class DrivePlanner {
 public:
  DrivePlanner(const SceneRequest& request, const WrittenScene& scene)
      : request_(request),
        scene_(scene),
        gravity_(request.world.gravity.value_or(Eigen::Vector3d(0, 0, -standard_gravity))) {}

  WrittenDrives plan() {
    for (int r = 0; r < static_cast<int>(request_.world.robots.size()); ++r) add_robot(r);
    return std::move(out_);
  }

 private:
  const RobotSpec& robot(int r) const {
    return request_.world.robots[static_cast<size_t>(r)].robot;
  }
  void add_robot(int r);
  void add_servo(int r, int d);
  void add_springy_servos(int r, int d, const std::vector<MovedBody>& joints);
  void add_own(int r, const ActuatorSpec& from);
  void add_joint_tendon(int r, const JointTendonSpec& from);
  bool drive_by_pulls(int r, const ActuatorSpec& from, WrittenActuator& out);
  void add_law(int r, const ActuatorSpec& from, WrittenActuator& out);
  const WrittenJoint* joint_named(int r, const std::string& name) const;
  std::string dof_label(int r, int d) const;
  void lose(const std::string& text) { out_.losses.push_back(text); }

  const SceneRequest& request_;
  const WrittenScene& scene_;
  Eigen::Vector3d gravity_;
  WrittenDrives out_;
  std::vector<std::string> names_, tendon_names_;
};

std::string DrivePlanner::dof_label(int r, int d) const {
  const std::string& name = robot(r).dofs[static_cast<size_t>(d)].name;
  return name.empty() ? fmt::format("dof{}", d + 1) : name;
}

const WrittenJoint* DrivePlanner::joint_named(int r, const std::string& name) const {
  for (const WrittenBody& body : scene_.bodies)
    for (const WrittenJoint& joint : body.joints)
      if (joint.robot == r && joint.spec->name == name) return &joint;
  return nullptr;
}

// --- servos of DOFs ---

// gains of the DOF as in dynamics, in units of its first joint
struct ServoLaw {
  double kp = 0, kd = 0;
};

ServoLaw servo_law(const DofSpec& dof, double inertia, double ratio) {
  ServoLaw out{dof.kp, dof.kd};
  if (dof.kp > 0 || dof.kd > 0)
    out.kd += 2 * dof.damping_ratio * std::sqrt(std::max(0.0, dof.kp) * inertia);
  else
    out = {inertia * servo_frequency * servo_frequency, 2 * inertia * servo_frequency};
  return {out.kp / (ratio * ratio), out.kd / (ratio * ratio)};
}

void DrivePlanner::add_servo(int r, int d) {
  const DofSpec& dof = robot(r).dofs[static_cast<size_t>(d)];
  const auto joints = joints_of_dof(scene_, r, d);
  if (joints.empty()) {
    if (dof.driven) lose(fmt::format("DOF '{}', which moves no joint", dof_label(r, d)));
    return;
  }
  if (!dof.driven) return;
  if (dof.kind == DofKind::compliant) return add_springy_servos(r, d, joints);
  const WrittenJoint& leader = *joints.front().joint;
  const double ratio = leader.spec->ratio;
  if (ratio == 0) return lose(fmt::format("the motor of DOF '{}'", dof_label(r, d)));
  const DofLoad load = load_of_dof(scene_, joints, gravity_);
  const ServoLaw law = servo_law(dof, load.inertia, ratio);
  WrittenActuator out;
  out.name = unique_name(dof_label(r, d), names_);
  out.joint = leader.name;
  out.gain = law.kp;
  out.bias = {0, -law.kp, -law.kd};
  if (!std::ranges::count(request_.unsupported, r)) out.hold = -load.weight / ratio;
  if (dof.max_effort > 0) {
    const double most = dof.max_effort / std::abs(ratio);
    out.force_range = {-most, most};
  }
  out.robot = r, out.dof = d;
  out.arms = {{leader.number, 1.0}};
  out.effort_share = 1 / ratio;
  out_.actuators.push_back(std::move(out));
}

// the tendon pulls each joint by a spring, which is written as a servo of the same stiffness
void DrivePlanner::add_springy_servos(int r, int d, const std::vector<MovedBody>& joints) {
  const DofSpec& dof = robot(r).dofs[static_cast<size_t>(d)];
  double squares = 0;
  bool sprung = true;
  for (const MovedBody& moved : joints) {
    squares += moved.joint->spec->ratio * moved.joint->spec->ratio;
    sprung = sprung && moved.joint->spec->spring > 0;
  }
  for (const MovedBody& moved : joints) {
    const JointSpec& joint = *moved.joint->spec;
    const double kp = sprung ? joint.spring : (dof.kp > 0 ? dof.kp : 1) / std::max(squares, 1e-12);
    const DofLoad load = load_of_dof(scene_, {moved}, gravity_);
    const double scale = joint.ratio == 0 ? 1 : joint.ratio * joint.ratio;
    WrittenActuator out;
    out.name = unique_name(dof_label(r, d), names_);
    out.joint = moved.joint->name;
    out.gain = kp;
    out.bias = {0, -kp, -2 * std::sqrt(kp * load.inertia / scale)};
    if (dof.max_effort > 0 && joint.ratio != 0) {
      const double most = dof.max_effort / std::abs(joint.ratio);
      out.force_range = {-most, most};
    }
    out.robot = r, out.dof = d;
    out.arms = {{moved.joint->number, 1.0}};
    // efforts are divided in proportion to the stiffness of the springs
    out.effort_share = joint.ratio / std::max(squares, 1e-12);
    out_.actuators.push_back(std::move(out));
  }
  lose(
      fmt::format("the tendon of compliant DOF '{}', which becomes a spring-like servo on each of "
                  "its joints",
                  dof_label(r, d)));
}

// --- actuators of MJCF files ---

void DrivePlanner::add_law(int r, const ActuatorSpec& from, WrittenActuator& out) {
  out.gear = from.gear;
  out.force_range = from.force_range;
  if (from.law_known) {
    out.gain = from.gain;
    out.gain_slopes = from.gain_slopes;
    out.bias = from.bias;
    out.control_range = from.activation_range ? from.activation_range : from.control_range;
  } else {
    lose(fmt::format("the law of actuator '{}', which becomes a motor", out.name));
    if (from.law_range) out.force_range = from.law_range;
  }
  if (from.activation_range)
    lose(fmt::format("the activation of actuator '{}', whose control takes its place", out.name));
  if (from.damping_ratio > 0 && from.dof >= 0) {
    const auto joints = joints_of_dof(scene_, r, from.dof);
    const double reach = joints.empty() ? 1 : from.gear * joints.front().joint->spec->ratio;
    const double inertia = load_of_dof(scene_, joints, gravity_).inertia / (reach * reach);
    out.bias[2] -= 2 * from.damping_ratio * std::sqrt(std::max(0.0, from.gain) * inertia);
  }
}

// a fixed tendon over the joints that the actuator pulls
bool DrivePlanner::drive_by_pulls(int r, const ActuatorSpec& from, WrittenActuator& out) {
  WrittenTendon tendon;
  for (const TendonPull& pull : from.pulls)
    if (const WrittenJoint* joint = joint_named(r, pull.joint)) {
      tendon.joints.emplace_back(joint->name, pull.coefficient);
      out.arms.emplace_back(joint->number, from.gear * pull.coefficient);
    }
  if (tendon.joints.empty()) return false;
  for (const WrittenTendon& other : out_.tendons)
    if (!other.spec && other.joints == tendon.joints) {
      out.tendon = other.name;
      return true;
    }
  tendon.name = unique_name(from.tendon.empty() ? from.name : from.tendon, tendon_names_);
  out.tendon = tendon.name;
  out_.tendons.push_back(std::move(tendon));
  return true;
}

void DrivePlanner::add_own(int r, const ActuatorSpec& from) {
  const std::string label = from.name.empty() ? from.joint + from.tendon : from.name;
  if (!from.enabled || from.gear == 0)
    return lose(fmt::format("actuator '{}', which exerts nothing", label));
  WrittenActuator out;
  out.robot = r, out.dof = from.dof;
  double reach = 0;
  if (const WrittenJoint* joint = from.joint.empty() ? nullptr : joint_named(r, from.joint)) {
    out.joint = joint->name;
    out.arms = {{joint->number, from.gear}};
    reach = from.gear * joint->spec->ratio;
  } else if (!from.pulls.empty() && drive_by_pulls(r, from, out)) {
    for (const auto& [number, arm] : out.arms)
      for (const MovedBody& moved : joints_of_dof(scene_, r, from.dof))
        if (moved.joint->number == number) reach += arm * moved.joint->spec->ratio;
  } else if (from.dof >= 0) {
    const auto joints = joints_of_dof(scene_, r, from.dof);
    if (joints.empty() || joints.front().joint->spec->ratio == 0)
      return lose(fmt::format("actuator '{}'", label));
    out.joint = joints.front().joint->name;
    out.arms = {{joints.front().joint->number, from.gear / joints.front().joint->spec->ratio}};
    reach = from.gear;
  } else {
    return lose(fmt::format("actuator '{}', which moves no joint", label));
  }
  out.name = unique_name(label, names_);
  add_law(r, from, out);
  if (!out.joint.empty() && from.joint.empty()) out.gear = out.arms.front().second;
  const auto drives_dof = [&](const WrittenActuator& other) {
    return other.robot == r && other.dof == from.dof && other.effort_share != 0;
  };
  // of several actuators of a DOF only one exerts the additional effort
  if (reach != 0 && out.gain != 0 && std::ranges::none_of(out_.actuators, drives_dof))
    out.effort_share = 1 / reach;
  out_.actuators.push_back(std::move(out));
}

void DrivePlanner::add_joint_tendon(int r, const JointTendonSpec& from) {
  WrittenTendon out;
  out.spec = &from;
  for (const auto& [dof, arm] : from.arms) {
    const auto joints = joints_of_dof(scene_, r, dof);
    if (joints.empty() || joints.front().joint->spec->ratio == 0) continue;
    const JointSpec& joint = *joints.front().joint->spec;
    out.joints.emplace_back(joints.front().joint->name, arm / joint.ratio);
    out.shift += arm / joint.ratio * joint.offset;
  }
  if (out.joints.empty()) return;
  out.name = unique_name(from.name.empty() ? "tendon" : from.name, tendon_names_);
  out_.tendons.push_back(std::move(out));
}

void DrivePlanner::add_robot(int r) {
  const RobotSpec& spec = robot(r);
  if (spec.actuators.empty())
    for (int d = 0; d < static_cast<int>(spec.dofs.size()); ++d) add_servo(r, d);
  for (const ActuatorSpec& actuator : spec.actuators) add_own(r, actuator);
  for (const JointTendonSpec& tendon : spec.joint_tendons) add_joint_tendon(r, tendon);
  if (!spec.tendons.empty() || !spec.wrappers.empty())
    lose(fmt::format("the {} tendons and {} wrappers of '{}'", spec.tendons.size(),
                     spec.wrappers.size(), excerpt(spec.name)));
  if (!spec.tactile.empty())
    lose(fmt::format("the {} tactile sensors of '{}'", spec.tactile.size(), excerpt(spec.name)));
}

}  // namespace

WrittenDrives plan_drives(const SceneRequest& request, const WrittenScene& scene) {
  return DrivePlanner(request, scene).plan();
}

double control_for(const WrittenActuator& actuator, const std::vector<double>& joints,
                   double effort) {
  double length = 0;
  for (const auto& [number, arm] : actuator.arms)
    length += arm * joints[static_cast<size_t>(number)];
  const double gain = actuator.gain + actuator.gain_slopes[0] * length;
  if (gain == 0) return 0;
  const double own = actuator.bias[0] + actuator.bias[1] * length;
  double control = (effort * actuator.effort_share - own) / gain;
  if (actuator.control_range)
    control = std::clamp(control, (*actuator.control_range)[0], (*actuator.control_range)[1]);
  return control;
}

}  // namespace clench
