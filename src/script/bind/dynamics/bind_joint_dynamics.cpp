#include "clench/dynamics/control/joint_dynamics.h"
#include "clench/dynamics/control/motors.h"
#include "clench/script/bind/dynamics/dynamics.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static JointDynamics of_robot(const RobotHandle& robot) {
  return joint_dynamics(*robot.world, robot.id);
}

static int inverse_dynamics(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto given = check_numbers(L, 2, "accelerations", static_cast<int>(robot->dofs.size()));
  for (const double a : given)
    check(Quantity{"acceleration", "rad/s^2 or m/s^2", -1e12, 1e12}, a, subject(L));
  const JointDynamics d = of_robot(robot);
  return push(L, d.mass_matrix * vector_of(given) + d.bias + d.passive);
}

static int get_gains(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Eigen::VectorXd inertia = of_robot(robot).mass_matrix.diagonal();
  int dof = 0;
  return push_list_of(L, robot->dofs, [&](const DofSpec&) {
    const Gains gains = gains_of(*robot.world, robot.id, dof, inertia[dof]);
    ++dof;
    push_record(L, {{"kp", gains.kp}, {"kd", gains.kd}});
  });
}

// settings in the value on top of the stack; false: those of the file
static std::optional<Gains> read_gain(lua_State* L, const std::string& what) {
  if (!lua_toboolean(L, -1)) return {};
  Table table(L, lua_gettop(L), what);
  const Gains gain{.kp = table.number("kp"), .kd = table.number("kd")};
  table.done();
  for (const double x : {gain.kp, gain.kd})
    check(Quantity{"gain", "N m/rad, N m s/rad, N/m or N s/m", 0, 1e12}, x, what);
  return gain;
}

static int set_gains(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  DynamicSettings settings = robot.world->dynamic_settings();
  auto& gains = settings.robots[robot.id].gains;
  const What what{L, {}, ""};
  const auto names = read_dof_names(L, 2, what);
  if (names.empty()) gains.clear();
  const size_t count = robot->dofs.size();
  if (given(L, 2) && names.empty()) {
    const int listed = read_list_size(L, 2, what, "a list of gains");
    if (listed != static_cast<int>(count))
      fail("{}: expected {}, one per DOF, got {}", subject(L), count, listed);
    for (int i = 1; i <= listed; ++i) {
      lua_rawgeti(L, 2, i);
      gains.push_back(read_gain(L, fmt::format("{}[{}]", subject(L), i)));
      lua_pop(L, 1);
    }
  }
  for (const std::string& name : names) {
    const auto dof = static_cast<size_t>(dof_named(name, robot, what));
    gains.resize(count);
    lua_getfield(L, 2, name.c_str());
    gains[dof] = read_gain(L, fmt::format("{}.{}", subject(L), name));
    lua_pop(L, 1);
  }
  robot.world->set_dynamic_settings(std::move(settings));
  return 0;
}

static const Entry joint_dynamics_fields[] = {
    {"gains", guarded<get_gains>, R"(
Position gains of its motors, one per DOF: those set by a script; otherwise those of its file; otherwise chosen such that a DOF settles at 60
rad/s with critical damping at its present posture. Set to a list, or to a table by DOF names, with false for the gains of the file; nil restores all of those.
@type {kp: number, kd: number}[]  [N m/rad or N/m], [N m s/rad or N s/m]
> hand.gains[1].kp  --> 1.0
> gains = hand.gains
> gains[1] = {kp = 20, kd = 0.5}
> hand.gains = gains
> hand.gains[1].kp  --> 20.0
> hand.gains = {dof2 = {kp = 30, kd = 1}, dof1 = false}
> hand.gains[2].kp, hand.gains[1].kp  --> 30.0, 1.0
> hand.gains = {dof44 = {kp = 30, kd = 1}}  --> error: has no DOF 'dof44'; did you mean 'dof4'?
> hand.gains = nil
> hand.gains[1].kp  --> 1.0
> hand.gains = {{kp = 1}}  --> error: expected 12, one per DOF, got 1
> hand.gains = {false, dof2 = false}  --> error: expected a list of gains, got a table with the key 'dof2')",
     guarded<set_gains>},
};

static const Entry joint_dynamics_methods[] = {
    {"mass_matrix", method<[](const RobotHandle& x) { return of_robot(x).mass_matrix; }>, R"(
Mass matrix of its DOFs at its present posture: half of v M v is the kinetic energy at DOF velocities v of the robot and everything that it
carries, with its base fixed. It includes the armature of the joints.
@return number[][] rows  one row and one column per DOF [kg m^2, kg m or kg]
@effect reads
> M = hand:mass_matrix()
> #M, #M[1], M[1][2] == M[2][1]  --> 12, 12, true)"},
    {"bias_forces", method<[](const RobotHandle& x) { return of_robot(x).bias; }>, R"(
Generalized forces on its DOFs due to velocities (Coriolis, centrifugal) and to weight, unless its motors compensate that: the efforts
for which no DOF accelerates, without springs and friction of the joints.
@return number[] forces  one per DOF [N m or N]
@effect reads
> hand.gravity_compensation = true
> math.abs(hand:bias_forces()[1]) < 1e-12  --> true)"},
    {"inverse_dynamics", guarded<inverse_dynamics>, R"(
Motor efforts required for these accelerations of the DOFs, without contacts: from the mass matrix, bias forces,
springs and viscous friction of the joints, but not their dry friction.
@param accelerations number[]  one per DOF [rad/s^2 or m/s^2]
@return number[] forces  one per DOF, as set_forces takes them [N m or N]
@effect reads
> accelerations = {}
> for i = 1, #hand.dofs do accelerations[i] = 0 end
> #hand:inverse_dynamics(accelerations)  --> 12
> hand:inverse_dynamics {1}  --> error: expected 12)"},
};

const Class joint_dynamics_class{.name = "joint_dynamics",
                                 .variable = "hand",
                                 .doc = "Masses and forces in the coordinates of a robot's DOFs.",
                                 .fields = joint_dynamics_fields,
                                 .methods = joint_dynamics_methods,
                                 .parent = &motion_class};

}  // namespace clench
