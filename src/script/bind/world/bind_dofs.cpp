#include <numbers>

#include "clench/base/convert.h"
#include "clench/dynamics/control/closing.h"
#include "clench/model/dof.h"
#include "clench/model/effort_range.h"
#include "clench/motion/drive.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

// --- values ---

static int get_named_dofs(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto q = robot.world->dofs(robot.id);
  push_list(L, 0, static_cast<int>(q.size()));
  for (int d = 0; d < q.size(); ++d) set_field(L, dof_name(*robot, d).c_str(), double{q[d]});
  return 1;
}

// rows {chain, joint, value} of joints that do not follow their DOFs
static std::vector<JointPosition> check_joint_positions(Table& options, const Robot& robot) {
  std::vector<JointPosition> out(robot.joints.size());
  for (const auto& row : options.rows("joint_positions", 3)) {
    const auto number = [&](double x, size_t count, const char* what) {
      if (!(x >= 1 && x <= static_cast<double>(count) && x == std::floor(x)))
        fail("{}: joint_positions: expected a {} from 1 to {}, got {}", options.subject(), what,
             count, x);
      return floor_between(x, size_t{1}, count) - 1;
    };
    const size_t c = number(row[0], robot.chains.size(), "chain");
    const auto joints = joints_of(robot, robot.chains[c]);
    const size_t j = number(row[1], joints.size(), "joint");
    const Joint& joint = robot.joints[joints[j]];
    if (!joint.endless && !(row[2] >= joint.min - 1e-9 && row[2] <= joint.max + 1e-9))
      fail("{}: joint_positions: joint {} of chain {}: expected a value in [{}, {}], got {}",
           options.subject(), j + 1, c + 1, joint.min, joint.max, row[2]);
    out[joints[j]] = row[2];
  }
  return out;
}

static int set_dofs(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Eigen::VectorXd values = check_dofs(L, 2, robot);
  Table options(L, 3);
  std::vector<JointPosition> own;
  if (options.has("joint_positions")) own = check_joint_positions(options, *robot);
  options.done();
  robot.world->set_dofs(robot.id, values);
  if (!own.empty()) {
    const Eigen::VectorXd q = robot.world->dofs(robot.id);
    robot.world->set_dofs_unchecked(robot.id, q, own);
  }
  return 0;
}

static int set_posture(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Eigen::VectorXd asked = check_dofs(L, 3, robot);
  robot.world->set_posture(robot.id, check_pose(L, 2, "pose"), asked);
  const auto reached = robot.world->dofs(robot.id);
  std::vector<int> stopped;
  for (int d = 0; d < asked.size(); ++d)
    if (reached[d] != asked[d]) stopped.push_back(d + 1);
  if (stopped.empty()) return push_nil(L);
  static const char told = 0;
  for (const int d : stopped)
    if (!dof_slides(*robot, d - 1) &&
        std::abs(asked[d - 1] - reached[d - 1]) > 2 * std::numbers::pi)
      warn_once(L, &told,
                fmt::format("{}: DOF {} stops at {:.4g} rad, {:.4g} were asked for; degrees? "
                            "clench.rad({:.4g}) is {:.4g}",
                            subject(L), d, reached[d - 1], asked[d - 1], asked[d - 1],
                            asked[d - 1] * std::numbers::pi / 180));
  return push(L, stopped);
}

static std::vector<Range> dof_limits(const RobotHandle& robot) {
  std::vector<Range> limits;
  for (const double q : robot.world->dofs(robot.id))
    limits.push_back(range_around(*robot, static_cast<int>(limits.size()), q));
  return limits;
}

static std::vector<std::string> dof_names(const RobotHandle& robot) {
  std::vector<std::string> names;
  for (size_t d = 0; d < robot->dofs.size(); ++d)
    names.push_back(dof_name(*robot, static_cast<int>(d)));
  return names;
}

static const char* dof_kind(DofKind kind) {
  static constexpr const char* names[] = {"rigid", "breakaway", "compliant"};
  return names[static_cast<int>(kind)];
}

static int get_effort_ranges(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  int dof = 0;
  return push_list_of(L, robot->dofs, [&](const DofSpec&) {
    const EffortRange range = effort_range(*robot.world, robot.id, dof++);
    push(L, std::array{range.low, range.high});
  });
}

static int get_max_effort(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto& most = robot.world->dynamic_settings().robot(robot.id).max_effort;
  return most ? push(L, *most) : push_nil(L);
}

static int set_max_effort(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  DynamicSettings settings = robot.world->dynamic_settings();
  auto& most = settings.robots[robot.id].max_effort;
  most.reset();
  if (given(L, 2)) {
    most = check_number(L, 2);
    check(positive_rule.called("largest effort"), *most, subject(L));
  }
  robot.world->set_dynamic_settings(std::move(settings));
  return 0;
}

static int get_dof_info(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  int number = 0;
  return push_list_of(L, robot->dofs, [&](const DofSpec& dof) {
    push_record(L,
                {{"kind", dof_kind(dof.kind)},
                 {"driven", dof.driven},
                 {"can_close", can_close(*robot.world, robot.id, number++)},
                 {"endless", bool(robot->endless[static_cast<size_t>(&dof - robot->dofs.data())])},
                 {"default_velocity", dof.default_velocity},
                 {"max_effort", dof.max_effort},
                 {"kp", dof.kp},
                 {"kd", dof.kd},
                 {"breakaway_torque", dof.breakaway_torque}});
    if (!dof.name.empty()) set_field(L, "name", dof.name);
    if (dof.max_velocity > 0) set_field(L, "max_velocity", dof.max_velocity);
    if (dof.damping_ratio > 0) set_field(L, "damping_ratio", dof.damping_ratio);
  });
}

// --- motion ---

static int push(lua_State* L, DofStop stop) {
  static constexpr const char* names[] = {"reached", "limit", "contact", "not_driven",
                                          "iteration_limit"};
  return push(L, names[static_cast<int>(stop)]);
}

int push_drive(lua_State* L, const WorldPtr& world, const DriveResult& result) {
  return push_record(L, {{"moved", result.moved},
                         {"stops", result.stops},
                         {"stopped_by", [&] { push_pairs(L, world, result.stopped_by); }},
                         {"queries", result.queries},
                         {"events", result.events}});
}

// `dofs`, or `stages` of them; empty: all at once
static std::vector<DofGroup> read_stages(lua_State* L, Table& options, const RobotHandle& robot) {
  std::vector<DofGroup> out;
  const auto read = [&](int i, const What& what) {
    out.push_back(read_dof_numbers(L, i, what, robot));
  };
  if (options.push("dofs") != LUA_TNIL) read(lua_gettop(L), options.what("dofs"));
  lua_pop(L, 1);
  if (!options.has("stages")) return out;
  if (!out.empty()) fail("{}: expected dofs or stages, got both", options.subject());
  options.each("stages", "a list of lists of DOFs", read);
  if (out.empty()) fail("{}: expected at least one stage, got none", options.what("stages").text());
  return out;
}

static int autograsp(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table options(L, 2);
  const double speed = options.number("speed", 1);
  const DriveOptions driving{.stop_at_contact = options.boolean("stop_at_contact", false)};
  const auto stages = read_stages(L, options, robot);
  const bool dynamic = options.boolean("dynamic", false);
  options.done();
  if (dynamic) {
    if (!stages.empty() || driving.stop_at_contact)
      fail(
          "{}: dynamic closes all DOFs by their motors; it takes no dofs, stages or "
          "stop_at_contact",
          options.subject());
    close_by_motors(*robot.world, robot.id, speed);
    return 0;
  }
  return push_drive(L, robot.world,
                    clench::autograsp(*robot.world, robot.id, speed, driving, stages));
}

static int open(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table options(L, 2);
  options.done();
  return push_drive(L, robot.world, open_hand(*robot.world, robot.id));
}

static int move_dofs(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Eigen::VectorXd targets = check_dofs(L, 2, robot);
  Table options(L, 3);
  const DriveOptions driving{.stop_at_contact = options.boolean("stop_at_contact", false)};
  options.done();
  return push_drive(L, robot.world, drive_to(*robot.world, robot.id, targets, driving));
}

static const Entry dofs_fields[] = {
    {"dofs", getter<[](const RobotHandle& x) { return x.world->dofs(x.id); }>, R"(
Values of its degrees of freedom; a copy, set as by set_dofs.
@type number[]  [rad or m]
> #hand.dofs  --> 12)",
     guarded<set_dofs>},
    {"named_dofs", guarded<get_named_dofs>, R"(
The same values by the names of dof_names; a copy, set as by set_dofs.
@type table<string, number>  [rad or m]
> hand.named_dofs.dof2 == hand.dofs[2]  --> true
> hand.named_dofs = {dof2 = 0.1}
> hand.dofs[2]  --> 0.1)",
     guarded<set_dofs>},
    {"dof_limits", getter<dof_limits>, R"(
Minimum and maximum of each DOF. A DOF that is endless in dof_info is not bounded by its range, a turn or a meter on
either side of its present value, except in closing and searches.
@type number[][]  [rad or m]
> #hand.dof_limits[1]  --> 2)"},
    {"dof_info", guarded<get_dof_info>, R"(
Data of each DOF from its file: name, if it has one, kind ("rigid", "breakaway", "compliant"), default_velocity
of closing [rad/s or m/s], max_effort [N m or N] (0: nothing limits it), max_velocity, if known, kp, kd, damping_ratio, where
if it has one, which adds 2 damping_ratio sqrt(kp inertia) to kd, breakaway_torque [N m],
driven: false for a DOF that no actuator of an MJCF file can move (there is none, or its gear, gain or range is 0), and endless:
true for one without limits. can_close: its motor can push in the direction of default_velocity. effort_ranges has the efforts that the motors can exert.
@type table[]
> hand.dof_info[1].kind  --> rigid)"},
    {"effort_ranges", guarded<get_effort_ranges>, R"(
Minimum and maximum effort that the motor of each DOF can exert at rest at its present value; math.huge if no limit is given,
{0, 0} for a DOF that is not driven. Limits are max_effort of dof_info in both directions and, for MJCF files, gear, gain,
bias, control range and force range of the actuators. Contact forces with torque_limits, verified grasps and
the motors of world:run stay within them.
@type number[][]  [N m or N]
> hand.effort_ranges[1]  --> {-5.0, 5.0})"},
    {"max_effort", guarded<get_max_effort>, R"(
Maximum effort, in both directions, of motors for which the file gives no limit; nil: unlimited.
@type number?  [N m or N]
> hand.max_effort  --> nil
> hand.max_effort = 5
> hand.max_effort  --> 5.0
> hand.max_effort = nil
> hand.max_effort = 0  --> error: largest effort)",
     guarded<set_max_effort>},
    {"dof_names", getter<dof_names>, R"(
Names of its DOFs in its file; "dof1" and so on if it has none.
@type string[]
> hand.dof_names[1]  --> dof1)"},
};

static const Entry dofs_methods[] = {
    {"set_dofs", guarded<set_dofs>, R"(
Sets DOFs at once, without collision checks; see move_dofs. Joints that had broken away, or were held against their
springs, follow their DOFs again, except those that the options name by chain, joint and present value [rad or m].
@param values number[]|table<string, number>  within the limits: all, or some by their names, the others as they are [rad or m]
@param options? table  joints of compliant DOFs
@option joint_positions? number[][] [rad or m]  rows {chain, joint, value}
@effect edits
> hand:set_dofs{dof1 = 0, dof3 = 0.2}
> hand.dofs[3]  --> 0.2
> hand:set_dofs{dof44 = 0.2}  --> error: has no DOF 'dof44'; did you mean 'dof4'?
> hand:set_dofs{dof3 = 20}  --> error: degrees? clench.rad(20) is 0.3491
> hand:set_dofs{1, 2, 3}  --> error: expected 12 DOF values, got 3)"},
    {"set_posture", guarded<set_posture>, R"(
Sets the pose of its base and all its DOFs at once, without collision checks; DOFs stop at their limits. All joints follow
their DOFs.
@param pose pose  pose of the base in the world
@param values number[]|table<string, number>  one per DOF, or some by name [rad or m]
@return index[]?  DOFs that stopped at a limit; nil: none
@effect edits
> hand:set_posture(hand.pose, hand.dofs)  --> nil
> hand:set_posture(hand.pose, {1})  --> error: expected 12 DOF values, got 1)"},
    {"move_dofs", guarded<move_dofs>, R"(
Drives all DOFs proportionally towards the given values, until contact stops them.
@param values number[]|table<string, number>  as of set_dofs
@param options? table  how it moves
@option stop_at_contact? boolean = false  true: end at the first new contact of any link
@return table result  as of autograsp
@effect edits
> hand:move_dofs(hand.dofs).moved  --> false)"},
    {"autograsp", guarded<autograsp>, R"(
Closes the hand: each DOF moves towards its limit in the direction of its default velocity until contact stops it. Breakaway
fingers continue past the stopped joint. The joints of compliant DOFs follow the balance of springs, contacts
and friction: the tendon keeps pulling, and they yield and slide, until contacts take any further pull. A negative speed
opens the hand. With `dynamic` nothing moves yet: its motors are set to close while the world runs, and nothing is returned.
@param options? table  how it closes
@option speed? number = 1  of all closing speeds, 1: those of the hand; negative: opens
@option stop_at_contact? boolean = false  true: end at the first new contact of any link
@option dofs? (index|string)[]  only these, by number or name
@option stages? (index|string)[][]  lists of DOFs that close one after the other
@option dynamic? boolean = false  true: by the motors, in simulated time
@return table result  `moved`, `stops` (one per DOF: "contact", "limit", "reached", "not_driven", "iteration_limit"), `stopped_by` (pairs), `queries`, `events`
@effect edits
> hand:autograsp().moved  --> false
> hand:open()
> hand:autograsp{dofs = {"dof2", 3}}.stops[1]  --> not_driven
> hand:autograsp{stages = {{1, 2, 3}, {4, 5, 6, 7, 8, 9}, {10, 11, 12}}}.moved  --> true
> hand:autograsp{sped = 1}  --> error: did you mean 'speed'?)"},
    {"open", guarded<open>, R"(
Opens the hand as far as possible. A hand that overlaps something is opened regardless of contacts until it is free.
@param options? table  no options yet
@return table result  as of autograsp
@effect edits
> hand:open().moved  --> true
> #world:contacts(hand, flask)  --> 0)"},
};

const Class dofs_class{
    .name = "dofs",
    .variable = "hand",
    .doc = "Degrees of freedom of a robot: setting, driving, closing and opening.",
    .fields = dofs_fields,
    .methods = dofs_methods,
    .parent = &kinematics_class};

}  // namespace clench
