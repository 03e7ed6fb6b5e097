#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/dynamics/control/closing.h"
#include "clench/dynamics/control/motors.h"
#include "clench/model/dof.h"
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

static int set_dof_velocities(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto values = check_numbers(L, 2, "", static_cast<int>(robot->dofs.size()));
  robot.world->set_dof_velocities(robot.id, vector_of(values));
  return 0;
}

using Switch = bool RobotDynamics::*;

template <Switch what>
static bool is_on(const RobotHandle& robot) {
  return robot.world->dynamic_settings().robot(robot.id).*what;
}

template <Switch what>
static void turn(const RobotHandle& robot, bool on) {
  DynamicSettings settings = robot.world->dynamic_settings();
  settings.robots[robot.id].*what = on;
  robot.world->set_dynamic_settings(std::move(settings));
}

static constexpr const char* mode_names[] = {"position", "velocity", "effort"};

static int get_controller(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  if (robot->dofs.empty()) return push(L, "position");
  const auto mode = [&](int dof) { return robot.world->control(robot.id, dof).mode; };
  for (int dof = 1; dof < static_cast<int>(robot->dofs.size()); ++dof)
    if (mode(dof) != mode(0)) return push(L, "mixed");
  return push(L, mode_names[static_cast<int>(mode(0))]);
}

static int set_controller(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const std::string name = check_string(L, 2);
  int mode = name == "none" ? static_cast<int>(ControlMode::effort) : -1;
  for (int i = 0; i < 3; ++i)
    if (name == mode_names[i]) mode = i;
  if (mode < 0)
    fail("{}: expected \"position\", \"velocity\", \"effort\" or \"none\", got {}", subject(L),
         in_quotes(name));
  DynamicState& state = robot.world->edit_dynamics();
  const auto q = robot.world->dofs(robot.id);
  for (int i = 0; i < q.size(); ++i) {
    DofControl& control = state.controls[robot->first_dof + static_cast<size_t>(i)];
    control = {.mode = static_cast<ControlMode>(mode), .target = q[i], .trajectory = {}};
  }
  return 0;
}

static int set_forces(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto forces = check_some_dofs(L, 2, robot);
  for (const auto& force : forces)
    if (force) check(load_rule.called("force"), *force, subject(L));
  DynamicState& state = robot.world->edit_dynamics();
  for (size_t i = 0; i < forces.size(); ++i)
    if (forces[i]) state.controls[robot->first_dof + i].effort = *forces[i];
  return 0;
}

static int get_efforts(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  std::vector<double> efforts(robot->dofs.size());
  if (const DynamicState* state = robot.world->dynamics();
      state && state->dof_efforts.size() >= robot->first_dof + efforts.size())
    std::copy_n(state->dof_efforts.begin() + static_cast<std::ptrdiff_t>(robot->first_dof),
                efforts.size(), efforts.begin());
  return push(L, efforts);
}

static int set_targets(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto targets = check_some_dofs(L, 2, robot);
  Table options(L, 3);
  const bool smooth = options.has("velocity");
  const double velocity = options.number("velocity", 0);
  options.done();
  for (int i = 0; i < static_cast<int>(targets.size()); ++i) {
    if (!targets[static_cast<size_t>(i)]) continue;
    const double target = within_limits(*robot, i, *targets[static_cast<size_t>(i)], "robot");
    if (smooth && target != robot.world->dofs(robot.id)[i]) {
      send_dof(*robot.world, robot.id, i, target, velocity);
      continue;
    }
    DofControl& control =
        robot.world->edit_dynamics().controls[robot->first_dof + static_cast<size_t>(i)];
    control = {.mode = ControlMode::position,
               .target = target,
               .effort = control.effort,
               .trajectory = {}};
  }
  return 0;
}

static int set_target_velocities(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto values = check_some_dofs(L, 2, robot);
  for (const auto& v : values)
    if (v) check(velocity_rule.called("velocity"), *v, subject(L));
  DynamicState& state = robot.world->edit_dynamics();
  for (size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    DofControl& control = state.controls[robot->first_dof + i];
    control = {.mode = ControlMode::velocity,
               .velocity = *values[i],
               .effort = control.effort,
               .trajectory = {}};
  }
  return 0;
}

static int set_floating(lua_State* L) {
  const bool on = check_boolean(L, 2);
  const auto& robot = self<RobotHandle>(L);
  if (on && robot->mounting) fail("{}: floating: another robot carries it", subject(L));
  turn<&RobotDynamics::floating>(robot, on);
  return 0;
}

static const Entry robot_dynamics_fields[] = {
    {"dof_velocities", getter<[](const RobotHandle& x) { return x.world->dof_velocities(x.id); }>,
     R"(
Velocities of its degrees of freedom; a copy.
@type number[]  [rad/s or m/s]
> hand.dof_velocities[1]  --> 0.0)",
     guarded<set_dof_velocities>},
    {"dof_efforts", guarded<get_efforts>, R"(
Forces of its motors in the last step.
@type number[]  [N m or N]
> hand.dof_efforts[1]  --> 0.0)"},
    {"controller", guarded<get_controller>, R"(
Mode of its motors: "position", they hold their targets with `gains`; "velocity", they hold the velocities
that are set; "effort" (or its synonym "none"), they exert only the forces given by set_forces, which is the initial mode of DOFs that no actuator of a MuJoCo
file drives; "mixed": not all equal. `set_targets`, `set_target_velocities` and
`autograsp {dynamic = true}` switch the DOFs that they move.
@type "position"|"velocity"|"effort"|"none"|"mixed"
> hand.controller  --> position
> hand.controller = "none"
> hand.controller = "pid"  --> error: "none")",
     guarded<set_controller>},
    {"gravity_compensation", getter<is_on<&RobotDynamics::gravity_compensation>>, R"(
Do its motors compensate the weight of its own links, without bodies welded to them, as controllers of real arms do? The weight of a
floating robot is never compensated.
@type boolean
> hand.gravity_compensation  --> true)",
     setter<turn<&RobotDynamics::gravity_compensation>>},
    {"breakaway", getter<is_on<&RobotDynamics::breakaway>>, R"(
Do joints leave their breakaway DOFs while the world runs, if a contact exceeds the breakaway torque? They are
then locked until the opening DOF returns to them. Otherwise, as in GraspIt!'s dynamics, the DOF drives all its joints rigidly.
@type boolean
> hand.breakaway  --> false)",
     setter<turn<&RobotDynamics::breakaway>>},
    {"floating", getter<is_on<&RobotDynamics::floating>>, R"(
Is its base free to move? Otherwise it is fixed, or moves with its set velocity.
@type boolean
> hand.floating  --> false)",
     guarded<set_floating>},
};

static const Entry robot_dynamics_methods[] = {
    {"set_forces", guarded<set_forces>, R"(
Sets the force of each motor from now on: in addition to that of its controller, or alone with the controller "none". DOFs that are
absent from a table by names keep their forces.
@param forces number[]|table<string, number>  [N m or N]
@effect edits
> hand:set_forces {dof2 = 0.5}
> hand:set_forces {1}  --> error: expected 12)"},
    {"set_targets", guarded<set_targets>, R"(
Sets the targets of its motors: at once, or along a smooth path (a quintic polynomial in time). DOFs that are absent from a table
by names keep theirs.
@param dofs number[]|table<string, number>  [rad or m]
@param options? table  how fast
@option velocity? number [rad/s or m/s, > 0]  the largest on the way
@effect edits
> hand:set_targets({dof2 = 0.3}, {velocity = 1})
> hand:set_targets({dof2 = 100})  --> error: must lie in)"},
    {"set_target_velocities", guarded<set_target_velocities>, R"(
Sets the target velocities of its motors. DOFs that are absent from a table by names keep theirs.
@param velocities number[]|table<string, number>  [rad/s or m/s]
@effect edits
> hand:set_target_velocities {dof2 = 0.1}
> hand:set_target_velocities {1}  --> error: expected 12)"},
    {"has_closed", method<[](const RobotHandle& x) { return has_closed(*x.world, x.id); }>, R"(
Has every finger closed? A finger has closed if its last link touches something, if it is at its limit, or if it is at rest after
the expected closing time.
@return boolean
@effect reads
> hand:has_closed()  --> false)"},
};

const Class robot_dynamics_class{.name = "robot_dynamics",
                                 .variable = "hand",
                                 .doc = "Dynamics of a robot and its motors.",
                                 .fields = robot_dynamics_fields,
                                 .methods = robot_dynamics_methods,
                                 .parent = &joint_dynamics_class};

}  // namespace clench
