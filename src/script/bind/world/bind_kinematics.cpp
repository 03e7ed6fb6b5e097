#include "clench/model/jacobian.h"
#include "clench/motion/inverse_kinematics.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

// a body, or a link's name
static Id<Body> check_part(lua_State* L, int i, const RobotHandle& robot) {
  if (lua_type(L, i) == LUA_TSTRING)
    return find_link(robot, check_string(L, i, "link"), subject(L));
  const auto* body = to<BodyHandle>(L, i);
  if (!body) fail_expected({L, {}, "link"}, "a body or the name of a link", i);
  if (body->world != robot.world)
    fail("{}: '{}' belongs to another world", subject(L), (*body)->name);
  return body->id;
}

static int jacobian(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto body = check_part(L, 2, robot);
  const Eigen::Vector3d p_B =
      given(L, 3) ? check_vec3(L, 3, "point") : Eigen::Vector3d(Eigen::Vector3d::Zero());
  return push_rows(L, dof_jacobian(*robot.world, robot.id, body, robot.world->pose(body) * p_B));
}

static IkOptions read_ik_options(lua_State* L, int i, const RobotHandle& robot) {
  Table options(L, i);
  IkOptions out;
  out.X_BT = options.pose("frame", out.X_BT);
  out.orientation = options.choice(
      "orientation",
      {{"full", IkOrientation::full}, {"axis", IkOrientation::axis}, {"none", IkOrientation::none}},
      out.orientation);
  if (options.push("dofs") != LUA_TNIL)
    out.dofs = read_dof_numbers(L, lua_gettop(L), options.what("dofs"), robot);
  lua_pop(L, 1);
  out.starts = options.integer("starts", out.starts);
  out.seed = options.seed("seed", out.seed);
  out.tolerance = options.number("tolerance", out.tolerance);
  out.angle_tolerance = options.number("angle_tolerance", out.angle_tolerance);
  out.collision_free = options.boolean("collision_free", out.collision_free);
  options.done();
  return out;
}

static int ik(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto body = check_part(L, 2, robot);
  const Pose X_WT = check_pose(L, 3, "pose");
  const IkResult result = inverse_kinematics(*robot.world, robot.id, body, X_WT,
                                             read_ik_options(L, 4, robot), &robot.world->context());
  return push_record(L, {{"reached", result.reached},
                         {"dofs", result.dofs},
                         {"distance", result.distance},
                         {"angle", result.angle},
                         {"starts", result.starts},
                         {"iterations", result.iterations},
                         {"in_collision", result.in_collision}});
}

static int random_posture(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push(L,
              clench::random_posture(*robot.world, robot.id, check_object<Random>(L, 2, "random")));
}

static const Entry kinematics_methods[] = {
    {"ik", guarded<ik>, R"(
Inverse kinematics: values of its DOFs within their limits that bring a link to a pose; moves nothing. If there are none,
returns the nearest ones, with a turn by 1 rad weighted like a displacement of 0.1 m.
@param link body|string  a link, or its name; or a body of a robot that it carries
@param pose pose  where it is to be, in the world
@param options? table  what is reached, and how it is searched for
@option frame? pose  what of the link is to be there, in its own frame
@option orientation? "full"|"axis"|"none" = "full"  axis: only the direction of +z is matched
@option dofs? (index|string)[]  that may move, all by default
@option starts? integer [1 to 1000000] = 20  largest number of starts, the first from where it is, the others at random
@option seed? integer = 0  seed of the random numbers
@option tolerance? number [m, > 0] = 1e-6  of the position
@option angle_tolerance? number [rad, > 0] = 1e-6  of the orientation
@option collision_free? boolean = false  true: nothing that it moves may collide
@return table result  `reached`, `dofs`, `distance` [m] and `angle` [rad] from the pose, `starts`, `iterations`, `in_collision` (starts that reached it, but collided)
@effect reads
> target = hand:link("chain0_link2").pose.position + clench.vec3(0, 0, 0.01)
> result = hand:ik("chain0_link2", {xyz = target}, {orientation = "none"})
> result.reached and result.distance < 1e-6  --> true
> hand.dofs = result.dofs
> (hand:link("chain0_link2").pose.position - target):norm() < 1e-6  --> true
> hand:ik("chain0_link2", {xyz = {9, 0, 0}}).reached  --> false
> hand:ik(flask, {})  --> error: none of the selected DOFs moves 'flask')"},
    {"jacobian", guarded<jacobian>, R"(
Jacobian of a point: a row for each of vx, vy, vz [m per unit of the DOF], wx, wy, wz [rad per unit], in world
axes, and a column for each DOF, including those of its joints that follow it.
@param link body|string  a link, or its name; or a body of a robot that it carries
@param point? vec3  in its frame, its origin by default [m]
@return number[][]
@effect reads
> J = hand:jacobian("chain0_link2", {0, 0, 0.01})
> {#J, #J[1]}  --> {6, 12}
> J[1][12]  --> 0.0)"},
    {"random_posture", guarded<random_posture>, R"(
Values for all its DOFs, uniformly distributed within the limits; an endless DOF gets a value
within dof_limits around its present value. Moves nothing.
@param random random  source of the random numbers
@return number[]  [rad or m]
@effect reads
> hand.dofs = hand:random_posture(clench.random(1))
> hand.dofs[12] == hand:random_posture(clench.random(1))[12]  --> true)"},
};

const Class kinematics_class{.name = "kinematics",
                             .variable = "hand",
                             .doc = "Kinematics of a robot: inverse kinematics and Jacobians.",
                             .methods = kinematics_methods,
                             .parent = &hand_class};

}  // namespace clench
