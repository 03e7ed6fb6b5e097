// Efforts of our drives, compared with the forces that MuJoCo computes for the same actuators.
#include <doctest/doctest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "../temporary.h"
#include "clench/base/random.h"
#include "clench/io/read/read.h"
#include "clench/model/effort_range.h"
#include "clench/model/world.h"
#include "support/listening.h"
#include "support/mujoco.h"

using namespace clench;
using clench::test::TemporaryFolder;

namespace {

using Range = std::array<double, 2>;
constexpr double far = 1e8;  // control that represents an arbitrary one

std::string attribute(const char* name, const std::optional<Range>& range) {
  return range ? fmt::format(" {}='{:.6g} {:.6g}'", name, (*range)[0], (*range)[1]) : "";
}

/// One of the actuators of a random model; attributes unknown to MuJoCo 2.2 are applied by their
/// rules.
struct Motor {
  std::string element, target;
  bool on_tendon = false;
  std::optional<Range> control, activation, force;
  bool integrates = false, has_activation = false, group_off = false;

  std::string text(bool for_old) const {
    return element + target + attribute("ctrlrange", control) + attribute("actrange", activation) +
           (for_old ? "" : attribute("forcerange", force)) + (group_off ? " group='3'" : "") + "/>";
  }
  /// bounds of the input of its law
  Range inputs() const {
    Range range = control.value_or(Range{-far, far});
    if (integrates) range = {range[0] < 0 ? -far : 0, range[1] > 0 ? far : 0};
    if (activation)
      for (double& x : range) x = std::clamp(x, (*activation)[0], (*activation)[1]);
    return range;
  }
};

/// Joints a and b, pulled by tendons; c, followed by d.
struct Gripper {
  std::array<bool, 4> slides;
  std::array<std::optional<Range>, 4> effort;  // actuatorfrcrange
  std::array<double, 2> coefficients;          // of the tendon of a and b
  std::optional<Range> tension;                // of that tendon
  double ratio = 1, offset = 0;                // of d
  std::vector<Motor> motors;
  bool off = false;

  explicit Gripper(Random& random);
  std::string text(bool for_old) const;

 private:
  Motor random_motor(Random& random);
};

std::optional<Range> random_range(Random& random, double size) {
  if (random.uniform() < 0.5) return {};
  const double a = random.uniform(-size, size), b = random.uniform(-size, size);
  Range out = {std::min(a, b), std::max(a, b)};
  // on one side of 0, or both
  if (const double side = random.uniform(); side < 0.2)
    out[0] = 0, out[1] = std::abs(out[1]) + 0.1;
  else if (side < 0.4)
    out[0] = -std::abs(out[0]) - 0.1, out[1] = 0;
  return out;
}

Motor Gripper::random_motor(Random& random) {
  Motor out;
  const auto number = [&](double low, double high) {
    return fmt::format("{:.6g}", random.uniform(low, high));
  };
  const double kind = random.uniform();
  out.control = random_range(random, 2);
  if (kind < 0.3) {
    out.element = "<motor";
  } else if (kind < 0.5) {
    out.element = "<general gaintype='affine' gainprm='" + number(-9, 9) + " " + number(-9, 9) +
                  " -1' biastype='affine' biasprm='" + number(-3, 3) + " " + number(-20, 20) +
                  " -1'";
  } else if (kind < 0.6) {
    out.element = "<velocity kv='" + number(0, 20) + "'";
  } else if (kind < 0.7) {
    out.element =
        "<cylinder " +
        (random.uniform() < 0.3 ? std::string("area='0'") : "diameter='" + number(0, 2) + "'") +
        " bias='" + number(-1, 1) + " 0 0'";
    out.has_activation = true;
  } else if (kind < 0.8) {
    out.element = "<damper kv='3'";
    out.control = Range{0, 1};
  } else if (kind < 0.9) {
    out.element = "<general dyntype='integrator' gainprm='50' biastype='affine' biasprm='0 -50 -1'";
    out.has_activation = out.integrates = true;
    out.activation = random_range(random, 0.5);
  } else {
    out.element = "<general gainprm='" + number(0, 50) + "' biastype='affine' biasprm='0 -" +
                  number(0, 50) + "'";
  }
  if (random.uniform() < 0.6) out.element += " gear='" + number(-3, 3) + "'";
  if (random.uniform() < 0.1) out.element += " gear='0'";
  if (out.element.find("gear") != out.element.rfind("gear"))
    out.element.erase(out.element.rfind(" gear"));
  out.force = random_range(random, 8);
  out.group_off = random.uniform() < 0.1;
  out.on_tendon = random.uniform() < 0.5;
  const std::array<const char*, 4> joints = {"a", "b", "c", "d"};
  out.target = out.on_tendon ? std::string(random.uniform() < 0.6 ? " tendon='ab'" : " tendon='cd'")
                             : fmt::format(" joint='{}'", joints[random.bits() % 4]);
  return out;
}

Gripper::Gripper(Random& random) {
  for (bool& slide : slides) slide = random.uniform() < 0.5;
  for (auto& range : effort)
    if (random.uniform() < 0.3) range = random_range(random, 5);
  for (double& c : coefficients) c = random.uniform(0.2, 2) * (random.uniform() < 0.5 ? 1 : -1);
  if (random.uniform() < 0.4) tension = random_range(random, 5);
  ratio = random.uniform(0.3, 2) * (random.uniform() < 0.5 ? 1 : -1);
  offset = random.uniform(-0.2, 0.2);
  const int count = 1 + static_cast<int>(random.bits() % 4);
  for (int i = 0; i < count; ++i) motors.push_back(random_motor(random));
  // the order required by MuJoCo 2.2
  std::ranges::stable_sort(motors, {}, &Motor::has_activation);
  // a separate test covers the scaling of several forces of one tendon
  if (tension &&
      std::ranges::count_if(motors, [](auto& m) { return m.target == " tendon='ab'"; }) > 1)
    tension.reset();
  off = random.uniform() < 0.05;
}

std::string Gripper::text(bool for_old) const {
  std::string bodies, actuators;
  for (int j = 0; j < 4; ++j)
    bodies += fmt::format(
        "<body name='{0}' pos='{1} 0 1'><joint name='{0}' axis='0 1 0' type='{2}' range='-1 1'{3}/>"
        "<geom size='0.1'/></body>",
        "abcd"[j], j, slides[j] ? "slide" : "hinge",
        for_old ? ""
                : attribute("actuatorfrcrange", effort[j]) +
                      (effort[j] ? " actuatorfrclimited='true'" : ""));
  for (const Motor& motor : motors) actuators += motor.text(for_old);
  return "<mujoco model='m'><compiler angle='radian' autolimits='true'/><option" +
         std::string(for_old ? "" : " actuatorgroupdisable='3'") + ">" +
         (off ? "<flag actuation='disable'/>" : "") +
         "</option><worldbody><body name='base'><geom size='0.1'/>" + bodies +
         "</body></worldbody><equality><joint joint1='d' joint2='c'" +
         fmt::format(" polycoef='{:.6g} {:.6g} 0 0 0'/></equality><tendon><fixed name='ab'", offset,
                     ratio) +
         (for_old || !tension
              ? ""
              : attribute("actuatorfrcrange", tension) + " actuatorfrclimited='true'") +
         fmt::format("><joint joint='a' coef='{:.6g}'/><joint joint='b' coef='{:.6g}'/></fixed>",
                     coefficients[0], coefficients[1]) +
         "<fixed name='cd'><joint joint='c' coef='0.7'/><joint joint='d' coef='-0.4'/></fixed>"
         "</tendon><actuator>" +
         actuators + "</actuator></mujoco>";
}

double rounded(double x) { return std::stod(fmt::format("{:.6g}", x)); }

double bounded(double x, const std::optional<Range>& range) {
  return range ? std::clamp(x, rounded((*range)[0]), rounded((*range)[1])) : x;
}

/// Efforts on the joints a to d by MuJoCo, for given controls, or activations, of the motors.
std::array<double, 4> efforts(const Gripper& gripper, const mjModel& m, mjData& d,
                              const std::vector<double>& inputs) {
  int act = 0;
  for (int i = 0; i < m.nu; ++i) {
    const Motor& motor = gripper.motors[static_cast<size_t>(i)];
    if (motor.has_activation)
      d.act[act++] = inputs[i];
    else
      d.ctrl[i] = inputs[i];
  }
  mj_forward(&m, &d);
  std::array<double, 4> out = {};
  for (int i = 0; i < m.nu; ++i) {
    const Motor& motor = gripper.motors[static_cast<size_t>(i)];
    if (motor.group_off || gripper.off) continue;
    double force = d.actuator_force[i];
    if (motor.target == " tendon='ab'") force = bounded(force, gripper.tension);
    force = bounded(force, motor.force);
    for (int j = 0; j < 4; ++j) out[j] += d.actuator_moment[i * m.nv + j] * force;
  }
  for (int j = 0; j < 4; ++j) out[j] = bounded(out[j], gripper.effort[j]);
  return out;
}

struct Extremes {
  double low = far * far, high = -far * far;

  void take(double x) { low = std::min(low, x), high = std::max(high, x); }
};

/// Compares a bound of a range with the effort for controls of +-1e8.
void check_end(double ours, double theirs) {
  if (std::isinf(ours))
    CHECK(theirs * (ours > 0 ? 1 : -1) > 1e3);
  else
    CHECK(std::abs(ours - theirs) <= 1e-6 * std::max(1.0, std::abs(theirs)));
}

}  // namespace

TEST_CASE("the efforts of a drive at rest are those that some control exerts in MuJoCo") {
  TemporaryFolder folder;
  int compared = 0, powerless = 0;
  for (uint64_t seed = 0; seed < 150; ++seed) {
    Random random(57, seed);
    const Gripper gripper(random);
    CAPTURE(seed);
    const std::string text = gripper.text(false);
    CAPTURE(text);
    std::array<char, 1000> error = {};
    const test::MujocoModel m(mj_loadXML(folder.write("old.xml", gripper.text(true)).c_str(),
                                         nullptr, error.data(), static_cast<int>(error.size())));
    INFO(std::string(error.data()));
    REQUIRE(m);
    const test::MujocoData d(mj_makeData(m.get()));
    ReadOptions options;
    options.diagnostics =
        test::Listening{.warn = [](const std::string&) {}, .note = [](const std::string&) {}};
    const RobotSpec spec = read_robot(folder.write("new.xml", text), options);
    World world;
    const Id<Robot> id = world.add_robot(spec, {});

    Eigen::VectorXd q(spec.dofs.size());
    for (int i = 0; i < q.size(); ++i) {
      const auto [low, high] = dof_range(spec, i);
      q[i] = random.uniform(low, high);
    }
    world.set_dofs(id, q);
    std::array<const JointSpec*, 4> joints = {};
    each_joint(spec, [&](const JointSpec& joint) { joints[joint.name[0] - 'a'] = &joint; });
    for (int j = 0; j < 4; ++j)
      d->qpos[j] = joints[j]->ratio * q[joints[j]->dof] + (j == 3 ? rounded(gripper.offset) : 0);

    const size_t count = gripper.motors.size();
    std::vector<Extremes> extremes(spec.dofs.size());
    for (size_t corner = 0; corner < size_t{1} << count; ++corner) {
      std::vector<double> inputs;
      for (size_t i = 0; i < count; ++i) {
        const Range range = gripper.motors[i].inputs();
        inputs.push_back(rounded(range[corner >> i & 1]));
      }
      const auto all = efforts(gripper, *m, *d, inputs);
      std::vector<double> by_dof(spec.dofs.size(), 0.0);
      for (int j = 0; j < 4; ++j) by_dof[joints[j]->dof] += joints[j]->ratio * all[j];
      for (size_t i = 0; i < by_dof.size(); ++i) extremes[i].take(by_dof[i]);
    }
    for (int i = 0; i < q.size(); ++i) {
      CAPTURE(spec.dofs[i].name);
      // if one actuator pulls joints against each other, the limits of each are not exact
      std::vector<const JointSpec*> own;
      for (const JointSpec* joint : joints)
        if (joint->dof == i) own.push_back(joint);
      const bool limited =
          std::ranges::any_of(own, [](auto* j) { return j->effort_range.has_value(); });
      if (own.size() > 1 && limited) continue;
      const EffortRange ours = effort_range(world, id, i);
      if (!world.robot(id).dofs[i].driven) {
        ++powerless;
        CHECK(ours.is_zero());
        // no control changes its effort
        CHECK(extremes[i].high - extremes[i].low <= 1e-9);
        continue;
      }
      ++compared;
      check_end(ours.low, extremes[i].low);
      check_end(ours.high, extremes[i].high);
    }
  }
  CHECK(compared > 100);
  CHECK(powerless > 50);
}
