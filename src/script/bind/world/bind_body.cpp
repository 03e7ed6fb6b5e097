#include "clench/base/text.h"
#include "clench/model/fingerprint.h"
#include "clench/script/bind/dynamics/dynamics.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"

#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static const char* kind_name(BodyKind kind) {
  static constexpr const char* names[] = {"object", "obstacle", "base", "link", "mount"};
  return names[static_cast<int>(kind)];
}

static int set_body_kind(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  const std::string kind = check_string(L, 2, "kind");
  for (const BodyKind known : {BodyKind::object, BodyKind::obstacle})
    if (kind == kind_name(known)) return body.world->set_kind(body.id, known), 0;
  fail("{}: kind: expected object, obstacle, got '{}'", subject(L), excerpt(kind));
}

static std::optional<RobotHandle> body_robot(const BodyHandle& body) {
  if (!body->robot) return {};
  return RobotHandle{body.world, body->robot};
}

static std::optional<Bounds> body_bounds(const BodyHandle& body) {
  if (!body->shape) return {};
  return body->shape->bounds_at(body.world->pose(body.id));
}

int push_move(lua_State* L, const WorldPtr& world, const MoveResult& result) {
  return push_record(L, {{"fraction", result.fraction},
                         {"touched", result.touched},
                         {"stopped_by", [&] { push_pairs(L, world, result.stopped_by); }},
                         {"iteration_limit", result.iteration_limit},
                         {"queries", result.queries}});
}

static int body_move_to(lua_State* L) {
  const auto& body = self<BodyHandle>(L);
  return push_move(L, body.world, move_body(*body.world, body.id, check_pose(L, 2, "pose")));
}

static std::string body_text(const BodyHandle& body) {
  if (!body.world->alive(body.id)) return "removed body";
  return fmt::format("{} '{}'", kind_name(body->kind), body->name);
}

static const Entry body_fields[] = {
    {"name", getter<[](const BodyHandle& x) { return x->name; }>, R"(
Name, unique in its world.
@type string
> flask.name = "bottle"
> world:body("bottle") == flask  --> true)",
     setter<[](const BodyHandle& x, const std::string& name) { x.world->set_name(x.id, name); }>},
    {"pose", getter<[](const BodyHandle& body) { return body.world->pose(body.id); }>, R"(
Its pose in the world frame. Setting it moves the body at once, without collision checks; see move_to. The parts of a robot
move with the robot.
@type pose
> flask.pose = {xyz = {0, 0, 1}}
> flask.pose.position  --> (0, 0, 1))",
     setter<[](const BodyHandle& x, const Pose& pose) { x.world->set_pose(x.id, pose); }>},
    {"kind", getter<[](const BodyHandle& x) { return kind_name(x->kind); }>, R"(
"object", "obstacle", "base", "link" or "mount". An obstacle that is set to "object" moves in simulations, and can be grasped; an object that is set to
"obstacle" stays where it is. Both come to rest.
@type string
> flask.kind  --> object
> flask.kind = "obstacle"
> #world.objects, world.obstacles[#world.obstacles] == flask  --> 0, true
> flask.kind = "link"  --> error: kind: expected object, obstacle, got 'link')",
     guarded<set_body_kind>},
    {"robot", getter<body_robot>, R"(
The robot that it is a part of; nil for objects and obstacles.
@type robot?
> hand.links[1].robot == hand  --> true)"},
    {"bounds_in_world", getter<body_bounds>, R"(
Minimum and maximum coordinates of its surface in the world frame; nil if it has none.
@type {low: vec3, high: vec3}?  [m]
> box = world:add_object(clench.shapes.box {1, 2, 4}, {pose = {xyz = {9, 0, 0}, rpy = {0, 0, clench.rad(90)}}})
> (box.bounds_in_world.high - clench.vec3(10, 0.5, 2)):norm() < 1e-12  --> true)"},
    {"source", getter<[](const BodyHandle& x) { return x->source; }>, R"(
File from which it was read; empty if a script made it.
@type string
> world:add_object(clench.shapes.box {1, 1, 1}).source == ""  --> true)"},
    {"tracker", getter<[](const BodyHandle& x) { return x->tracker; }>, R"(
Number of the position sensor that should move it; nil if its file names none.
@type integer?
> flask.tracker  --> nil)"},
};

// the body with that id in a clone of its world
static int body_in_world(lua_State* L) {
  const BodyHandle& body = self<BodyHandle>(L);
  const WorldPtr world = check_object<WorldHandle>(L, 2, "world").world;
  if (!world->alive(body.id) || world->body(body.id).name != body->name)
    fail("{}: expected a clone of its world, got one without '{}' in its place", subject(L),
         excerpt(body->name));
  return push_object(L, BodyHandle{world, body.id});
}

static const Entry body_methods[] = {
    {"in_world", guarded<body_in_world>, R"(
The same body in a clone of its world, or in the world of which its own is a clone.
@param world world  a clone of its world, or the world of which its own is a clone
@return body
@effect reads
> copy = world:clone()
> flask:in_world(copy).world == copy, flask:in_world(copy).name  --> true, flask
> flask:in_world(clench.world())  --> error: expected a clone of its world)"},
    {"move_to", guarded<body_move_to>, R"(
Moves an object or obstacle along the straight line and shortest turn until it first touches something. The gap that
remains is within the contact threshold. A body that starts in contact may slide along it or move away, but not move inwards.
@param pose pose  target pose in the world
@return table result  `fraction` of the way gone, `touched`, `stopped_by` (pairs), `iteration_limit` (after a million steps), `queries`
@effect edits
> cube = world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {pose = {xyz = {0, 0, 9}}})
> floor = world:add_obstacle(clench.shapes.box {1, 1, 1}, {pose = {xyz = {0, 0, 7}}})
> cube:move_to{xyz = {0, 0, 7}}.touched  --> true
> world:distance(cube, floor) <= world.contact_threshold  --> true)"},
};

static const Entry body_operators[] = {
    {"__tostring", method<body_text>, ""},
    {"__eq", equality<BodyHandle>, ""},
};

const Class body_class{
    .name = "body",
    .variable = "body",
    .doc = "A rigid body in a world: an object, an obstacle, or a part of a robot.",
    .fields = body_fields,
    .methods = body_methods,
    .operators = body_operators,
    .parent = &motion_class};

}  // namespace clench
