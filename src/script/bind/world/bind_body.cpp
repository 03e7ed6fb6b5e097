#include "clench/script/bind/bind.h"
#include "clench/script/bind/dynamics/dynamics.h"

#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static int set_name(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  body.world->set_name(body.id, check_string(L, 2));
  return 0;
}

static int set_body_pose(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  body.world->set_pose(body.id, check_pose(L, 2));
  return 0;
}

static const char* kind_name(BodyKind kind) {
  static constexpr const char* names[] = {"object", "obstacle", "base", "link", "mount"};
  return names[static_cast<int>(kind)];
}

static int get_robot(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  if (body->robot) return push(L, RobotHandle{body.world, body->robot});
  lua_pushnil(L);
  return 1;
}

static int get_body_bounds(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  if (!body->shape) {
    lua_pushnil(L);
    return 1;
  }
  const Bounds bounds = body->shape->bounds_at(body.world->pose(body.id));
  push_list(L, 0, 2);
  set_field(L, "low", bounds.low);
  set_field(L, "high", bounds.high);
  return 1;
}

static int get_body_tracker(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  if (body->tracker) return push(L, *body->tracker);
  lua_pushnil(L);
  return 1;
}

int push_move(lua_State* L, const WorldPtr& world, const MoveResult& result) {
  push_list(L, 0, 5);
  set_field(L, "fraction", result.fraction);
  set_field(L, "touched", result.touched);
  push_pairs(L, world, result.stopped_by);
  lua_setfield(L, -2, "stopped_by");
  set_field(L, "iteration_limit", result.iteration_limit);
  set_field(L, "queries", result.queries);
  return 1;
}

static int body_move_to(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  return push_move(L, body.world, move_body(*body.world, body.id, check_pose(L, 2, "pose")));
}

static int body_text(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  if (!body.world->alive(body.id)) return push(L, "removed body");
  return push(L, fmt::format("{} '{}'", kind_name(body->kind), body->name));
}

static int body_equal(lua_State* L) {
  const auto *a = to<BodyHandle>(L, 1), *b = to<BodyHandle>(L, 2);
  return push(L, a && b && a->world == b->world && a->id == b->id);
}

static const Entry body_fields[] = {
    {"name", getter<[](const BodyHandle& x) { return x->name; }>, R"(
Unique in its world.
@type string
> flask.name = "bottle"
> world:body("bottle") == flask  --> true)",
     guarded<set_name>},
    {"pose", getter<[](const BodyHandle& body) { return body.world->pose(body.id); }>, R"(
Where it is, in the world frame. Setting it moves it at once, whatever is in the way; see move_to. The parts of a robot
move with the robot.
@type pose
> flask.pose = {xyz = {0, 0, 1}}
> flask.pose.position  --> (0, 0, 1))",
     guarded<set_body_pose>},
    {"kind", getter<[](const BodyHandle& x) { return kind_name(x->kind); }>, R"(
"object", "obstacle", "base", "link" or "mount".
@type string
> flask.kind  --> object)"},
    {"robot", guarded<get_robot>, R"(
The robot that it is a part of; nil for objects and obstacles.
@type robot?
> hand.links[1].robot == hand  --> true)"},
    {"bounds_in_world", guarded<get_body_bounds>, R"(
Least and largest coordinates of its surface in the world frame; nil when it has none.
@type {low: vec3, high: vec3}?  [m]
> box = world:add_object(clench.shapes.box {1, 2, 4}, {pose = {xyz = {9, 0, 0}, rpy = {0, 0, clench.rad(90)}}})
> (box.bounds_in_world.high - clench.vec3(10, 0.5, 2)):norm() < 1e-12  --> true)"},
    {"source", getter<[](const BodyHandle& x) { return x->source; }>, R"(
File that it was read from; empty when it was made by a script.
@type string
> world:add_object(clench.shapes.box {1, 1, 1}).source == ""  --> true)"},
    {"tracker", guarded<get_body_tracker>, R"(
Number of the position sensor that is to move it; nil when its file names none.
@type integer?
> flask.tracker  --> nil)"},
};

static const Entry body_methods[] = {
    {"move_to", guarded<body_move_to>, R"(
Moves an object or obstacle along the straight line and shortest turn until it first touches something. The gap that
remains is within the contact threshold. One that starts in contact may slide or move away, but not inwards.
@param pose pose
@return table result  `fraction` of the way gone, `touched`, `stopped_by` (pairs), `iteration_limit` (after a million steps), `queries`
> cube = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {pose = {xyz = {0, 0, 9}}})
> floor = world:add_obstacle(clench.shapes.box {1, 1, 1}, {pose = {xyz = {0, 0, 7}}})
> cube:move_to{xyz = {0, 0, 7}}.touched  --> true
> world:distance(cube, floor) <= world.contact_threshold  --> true)"},
};

static const Entry body_operators[] = {
    {"__tostring", guarded<body_text>, ""},
    {"__eq", guarded<body_equal>, ""},
};

const Class body_class{.name = "body",
                       .variable = "body",
                       .doc =
                           "A rigid body in a world: an object, an "
                           "obstacle, or a part of a robot.",
                       .fields = body_fields,
                       .methods = body_methods,
                       .operators = body_operators,
                       .parent = &motion_class};

}  // namespace clench
