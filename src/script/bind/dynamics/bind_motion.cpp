#include "clench/dynamics/weld.h"
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

static int push(lua_State* L, const Twist& twist) {
  return push_record(L, {{"linear", twist.linear}, {"angular", twist.angular}});
}

static int set_velocity(lua_State* L) {
  const auto body = self_body(L);
  if (!lua_istable(L, 2) || lua_rawlen(L, 2) > 0)
    fail_expected({L, {}, ""}, "{linear = {x, y, z}, angular = {x, y, z}}", 2);
  if (body.world->dynamic_settings().welds.contains(body.id))
    fail("{}: it is welded, and moves with the other body", subject(L));
  Table table(L, 2);
  const Twist now = body.world->twist(body.id);
  const Eigen::Vector3d linear = table.vec3("linear", now.linear),
                        angular = table.vec3("angular", now.angular);
  table.done();
  body.world->set_twist(body.id, {linear, angular});
  return 0;
}

static BodyHandle pushed_body(lua_State* L) {
  const auto body = self_body(L);
  if (body->kind == BodyKind::obstacle)
    fail("{}: an obstacle moves with its set velocity, independent of forces", subject(L));
  if (body->kind != BodyKind::base) return body;
  const World& world = *body.world;
  if (!world.robot(body->robot).mounting && !world.dynamic_settings().robot(body->robot).floating)
    fail(
        "{}: the base is fixed or moves with its set velocity, independent of forces, unless "
        "`floating` is true",
        subject(L));
  return body;
}

static int apply_force(lua_State* L) {
  const auto body = pushed_body(L);
  const Eigen::Vector3d force = check_vec3(L, 2, "force");
  const Eigen::Vector3d com = body.world->pose(body.id) * body->com;
  const Eigen::Vector3d point = given(L, 3) ? check_vec3(L, 3, "point") : com;
  check(load_rule.called("force"), force, subject(L));
  check(coordinate_rule.called("point"), point, subject(L));
  Load& load = body.world->edit_dynamics().loads[body.id.index];
  load.force += force;
  load.torque += (point - com).cross(force);
  return 0;
}

static int apply_torque(lua_State* L) {
  const auto body = pushed_body(L);
  const Eigen::Vector3d torque = check_vec3(L, 2, "torque");
  check(load_rule.called("torque"), torque, subject(L));
  body.world->edit_dynamics().loads[body.id.index].torque += torque;
  return 0;
}

static Eigen::Vector3d surface_velocity(const Entity& body) {
  const auto& belts = body.world->dynamic_settings().surface_velocities;
  const auto found = belts.find(body.id);
  return found == belts.end() ? Eigen::Vector3d(0, 0, 0) : found->second;
}

static int set_surface_velocity(lua_State* L) {
  const auto body = self_body(L);
  const Eigen::Vector3d velocity = check_vec3(L, 2);
  check(velocity_rule.called("surface velocity"), velocity, subject(L));
  DynamicSettings settings = body.world->dynamic_settings();
  settings.surface_velocities.erase(body.id);
  if (!velocity.isZero(0)) settings.surface_velocities[body.id] = velocity;
  body.world->set_dynamic_settings(std::move(settings));
  return 0;
}

static std::optional<BodyHandle> welded_to(const Entity& body) {
  const auto& welds = body.world->dynamic_settings().welds;
  const auto found = welds.find(body.id);
  if (found == welds.end()) return {};
  return BodyHandle{body.world, found->second};
}

static int weld_to(lua_State* L) {
  const auto body = self_body(L);
  const auto to = check_bodies(L, 2, "to", body.world);
  weld(*body.world, body.id, to.front());
  return 0;
}

static const Entry motion_fields[] = {
    {"velocity", getter<[](const Entity& x) { return x.world->twist(x.id); }>, R"(
Velocity of its center of mass and angular velocity, in world axes. Contacts do not change the velocities of obstacles and of bases of robots.
Returns a copy; setting a table changes the keys that it contains. Setting a pose brings a body to rest.
@type {linear: vec3, angular: vec3}  [m/s], [rad/s]
> flask.velocity = {linear = {0, 0, 1}}
> flask.velocity.linear  --> (0, 0, 1)
> flask.velocity = {linear = {0, 0, 1 / 0}}  --> error: velocity)",
     guarded<set_velocity>},
    {"surface_velocity", getter<surface_velocity>, R"(
Surface velocity of a conveyor belt, in the body frame: touching bodies are carried along at this velocity although the belt's body does not move. Only the component along the surface counts.
@type vec3  [m/s]
> flask.surface_velocity = {0.1, 0, 0}
> flask.surface_velocity  --> (0.1, 0, 0)
> flask.surface_velocity = {1e9, 0, 0}  --> error: surface velocity)",
     guarded<set_surface_velocity>},
    {"welded_to", getter<welded_to>, R"(
The body that it is welded to, or nil.
@type body?
> flask.welded_to  --> nil)"},
};

static const Entry motion_methods[] = {
    {"apply_force", guarded<apply_force>, R"(
Applies a force in the next step only; forces add up. Obstacles and bases of robots that do not float
cannot be pushed.
@param force vec3  in world axes [N]
@param point? vec3  where, in the world; its center of mass by default [m]
@effect edits
> flask:apply_force({0, 0, 1})
> flask:apply_force({0, 0, 0 / 0})  --> error: force)"},
    {"apply_torque", guarded<apply_torque>, R"(
Applies a torque in the next step only.
@param torque vec3  in world axes [N m]
@effect edits
> flask:apply_torque({0, 0, 0.1})
> flask:apply_torque({0, 0, 0 / 0})  --> error: torque)"},
    {"weld", guarded<weld_to>, R"(
Welds it to another body at their present relative pose: in runs the two move as one rigid body, until it is unwelded.
Contacts between the two end. Their momentum is conserved, as in a perfectly inelastic collision. If a script moves one of them, they stay
welded at the new relative pose. Collision tests are not affected.
@param to body|robot  a body that does not hang on it by welds; of a robot its base
@effect edits
> flask:weld(hand.links[3])
> flask.welded_to == hand.links[3]  --> true
> flask:weld(hand.base)  --> error: is welded to)"},
    {"unweld", method<[](const Entity& x) { unweld(*x.world, x.id); }>, R"(
Removes the weld: from then on it moves separately, starting at its present velocity.
@effect edits
> flask:weld(hand.base)
> flask:unweld()
> flask.welded_to  --> nil
> flask:unweld()  --> error: is not welded)"},
};

const Class motion_class{.name = "motion",
                         .variable = "body",
                         .doc = "Motion of bodies and robots: velocity, and applied forces.",
                         .fields = motion_fields,
                         .methods = motion_methods,
                         .parent = &entity_class};

}  // namespace clench
