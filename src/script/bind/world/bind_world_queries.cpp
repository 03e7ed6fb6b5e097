#include <limits>
#include <optional>

#include "clench/model/penetration.h"
#include "clench/model/raycast.h"
#include "clench/script/bind/dynamics/dynamics.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/world/contacts.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

// --- contacts ---

static int cast(lua_State* L) {
  const WorldPtr& world = self<WorldHandle>(L).world;
  const Eigen::Vector3d origin = check_vec3(L, 2, "origin"), along = check_vec3(L, 3, "direction");
  const double reach =
      given(L, 4) ? check_number(L, 4, "reach") : std::numeric_limits<double>::infinity();
  if (!(along.stableNorm() > 1e-9))
    fail("{}: direction: expected a direction, got zero", subject(L));
  if (!(reach >= 0)) fail("{}: reach: expected a number >= 0 [m], got {}", subject(L), reach);
  const auto hit = raycast(*world, origin, along.stableNormalized(), reach);
  if (!hit) return push_nil(L);
  return push_record(L, {{"body", BodyHandle{world, hit->body}},
                         {"point", hit->p_W},
                         {"normal", hit->n_W},
                         {"distance", hit->distance},
                         {"triangle", hit->triangle + 1}});
}

static int collides(lua_State* L) {
  const WorldPtr& world = self<WorldHandle>(L).world;
  if (!given(L, 2)) return push(L, clench::collides(*world, &world->context()));
  return push(L, clench::collides(*world, check_bodies(L, 2, "entity", world), &world->context()));
}

// the option `max`; nullopt: all pairs
static std::optional<size_t> max_pairs(lua_State* L, int options_at) {
  constexpr int all = -1;
  Table options(L, options_at);
  const bool limited = options.has("max");
  const int max = options.integer("max", all);
  options.done();
  if (!limited) return {};
  return static_cast<size_t>(max);
}

static int colliding(lua_State* L) {
  const auto& world = self<WorldHandle>(L).world;
  const std::optional<size_t> max = max_pairs(L, 4);
  if (!given(L, 2) && !given(L, 3))
    return push_pairs(L, world,
                      max ? first_colliding_pairs(*world, *max, &world->context())
                          : colliding_pairs(*world, &world->context()));
  const auto a = given(L, 2) ? check_bodies(L, 2, "a", world) : world->bodies();
  const auto b = given(L, 3) ? check_bodies(L, 3, "b", world) : world->bodies();
  auto pairs = colliding_pairs(*world, a, b, &world->context());
  if (max && *max < pairs.size()) pairs.resize(*max);
  return push_pairs(L, world, pairs);
}

static int measure_distance(lua_State* L) {
  const auto& world = self<WorldHandle>(L).world;
  const auto a = check_bodies(L, 2, "a", world), b = check_bodies(L, 3, "b", world);
  const BodyDistance d =
      distance(*world, a, b, std::numeric_limits<double>::infinity(), &world->context());
  push_unbounded(L, d.distance);
  push(L, d.p_a);
  push(L, d.p_b);
  return 3;
}

static int measure_penetration(lua_State* L) {
  const auto& world = self<WorldHandle>(L).world;
  const auto a = check_bodies(L, 2, "a", world), b = check_bodies(L, 3, "b", world);
  const BodyPenetration found =
      penetration(*world, a, b, {.progress = world->context().progress()});
  push_unbounded(L, found.depth);
  if (!found.a) return 1;
  push(L, found.p_W);
  return 2;
}

static int find_contacts(lua_State* L) {
  const auto& world = self<WorldHandle>(L).world;
  if (!given(L, 2)) return push_contacts(L, world, contacts(*world, &world->context()));
  const auto a = check_bodies(L, 2, "a", world);
  const auto b = given(L, 3) ? check_bodies(L, 3, "b", world) : world->bodies();
  // one argument: the contacts on it
  return push_contacts(L, world,
                       given(L, 3) ? contacts(*world, a, b, &world->context())
                                   : contacts(*world, b, a, &world->context()));
}

// --- tables ---

static const Entry world_queries_methods[] = {
    {"raycast", guarded<cast>, R"(
The first hit of a ray: `body`, `point`, `normal` out of its surface, `distance` [m] and `triangle`; nil if it hits nothing.
@param origin vec3 [m]  first point of the ray in the world
@param direction vec3  of any length
@param reach? number  how far it goes [m]; as far as there is something by default
@return table?
@effect reads
> box = world:add_object(clench.shapes.box {1, 1, 1}, {pose = {xyz = {0, 0, 9}}})
> hit = world:raycast({0, 0, 20}, {0, 0, -1})
> hit.body == box, hit.distance, hit.normal  --> true, 10.5, (0, 0, 1)
> world:raycast({0, 0, 20}, {0, 0, -1}, 10)  --> nil)"},
    {"collides", guarded<collides>, R"(
Does any enabled pair of bodies collide, in the world or of one entity with anything? The fastest test: it ends at the first pair that is found.
@param entity? body|robot  body or robot to test against all others
@return boolean
@effect reads
> world:collides(hand)  --> false
> world:collides()  --> false)"},
    {"colliding", guarded<colliding>, R"(
Pairs of bodies that collide, of the world, of one entity, or between two. A closed body inside another collides too.
@param a? body|robot  one of two
@param b? body|robot  the other
@param options? table  how many
@option max? integer [>= 0]  largest number of pairs, the first ones in creation order; all by default
@return body[][]  pairs
@effect reads
> #world:colliding()  --> 0
> #world:colliding(nil, nil, {max = 10})  --> 0)"},
    {"distance", guarded<measure_distance>, R"(
Minimum distance of two things, 0 if they collide, with the closest points in the world frame.
@param a body|robot  one of two
@param b body|robot  the other
@return number distance  [m]; infinite where one has no surface, and from a body to itself
@return vec3 on_a
@return vec3 on_b
@effect reads
> world:distance(hand, flask) <= world.contact_threshold  --> true)"},
    {"penetration", guarded<measure_penetration>, R"(
Depth of the overlap: the largest distance from the surface of `b` of all points of `a` inside it, with that point in the
world frame. It is at most 1 um + 0.1 % below the true one, and 0 only if the two do not overlap or just touch. Nothing is
inside an open mesh: if that of `b` is open, points of `b` inside `a` count; if both are, the depth is infinite if they intersect.
@param a body|robot  one of two
@param b body|robot  the other
@return number depth  [m]
@return vec3? point  the deepest one; none where nothing overlaps
@effect reads
> box = world:add_object(clench.shapes.box {1, 1, 1}, {pose = {xyz = {0, 0, 9}}})
> ball = world:add_object(clench.shapes.sphere {0.1}, {pose = {xyz = {0, 0, 9.55}}})
> math.abs(world:penetration(ball, box) - 0.05) < 1e-4  --> true
> world:penetration(hand, flask)  --> 0.0)"},
    {"contacts", guarded<find_contacts>, R"(
Contacts: all, those on one entity, or those of `a` on `b`. After a step they include all that carried force in it; a ball touches
as a sphere, outside its facets.
@param a? body|robot  only contacts of this one
@param b? body|robot  only contacts between both
@return contact[]  on b; without arguments on the object of each pair
@effect reads
> world:contacts(hand, flask)[1].body == flask  --> true)"},
};

const Class world_queries_class{
    .name = "world_queries",
    .variable = "world",
    .doc = "Queries of a world: collisions, distances, contacts, ray casts.",
    .methods = world_queries_methods,
    .parent = &world_dynamics_class};

}  // namespace clench
