#include "clench/script/bind/picture/read_scene.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/scene/film_scene.h"
#include "clench/scene/force_arrows.h"
#include "clench/scene/ghosts.h"
#include "clench/scene/palette.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/world/contacts.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/table.h"

namespace clench {

static constexpr double longest_arrow = 0.6;  // as a fraction of the object's largest radius

// the list `forces` of a result of grasp:contact_forces
struct GivenForces {
  std::vector<PlacedForce> forces;
  std::vector<Id<Robot>> robots;  // forces that press
  std::vector<Contact> contacts;  // one per force
  double longest = 0;             // arrow length in proportion to the objects [m]
};

static GivenForces read_forces(lua_State* L, Table& options) {
  GivenForces given;
  if (options.push("forces") != LUA_TNIL) {
    if (!lua_istable(L, -1)) fail_expected(options.what("forces"), "a list of forces", -1);
    const int list = lua_gettop(L), count = static_cast<int>(lua_rawlen(L, list));
    for (int i = 1; i <= count; ++i) {
      lua_rawgeti(L, list, i);
      Table item(L, lua_gettop(L), options.what("forces").item(i).text());
      const auto* contact = item.object<ContactHandle>("contact");
      if (!contact) fail_expected(item.what("contact"), "a contact", lua_gettop(L) + 1);
      given.forces.push_back({contact->contact.p_W, item.vec3("force")});
      given.contacts.push_back(contact->contact);
      given.robots.push_back(contact->world->body(contact->contact.other).robot);
      const double radius = contact->world->body(contact->contact.body).max_radius();
      given.longest = std::max(given.longest, longest_arrow * radius);
      lua_pop(L, 1);
    }
  }
  lua_pop(L, 1);
  return given;
}

static void add_forces(Table& options, const GivenForces& given, Scene& scene) {
  const double longest = given.longest > 0 ? given.longest : 1;
  const std::vector<PlacedForce> forces = patch_forces(given.contacts, given.forces);
  const double scale = options.number("force_scale", force_scale(forces, longest));
  for (DrawArrow& arrow : force_arrows(forces, scale)) {
    arrow.shown.kind = Shown::Kind::force;
    scene.arrows.push_back(arrow);
  }
  scene.labels = force_labels(forces, scale);
  if (!scene.labels.empty())
    scene.caption = {fmt::format("forces on the object, the largest {}", scene.labels[0].text)};
}

// heights in proportion to normal forces; those of grasp:contact_forces identify their contacts
static std::vector<ContactLoad> read_loads(const GivenForces& given) {
  std::vector<ContactLoad> loads;
  for (size_t i = 0; i < given.forces.size(); ++i)
    loads.push_back({given.forces[i].p_W, given.forces[i].f_W.dot(given.contacts[i].n_W)});
  return loads;
}

static void read_cones(Table& options, const GivenForces& given, SceneOptions& showing) {
  showing.cone_sizes = options.choice("cones",
                                      {{"apart", ConeSizes::apart},
                                       {"equal", ConeSizes::equal},
                                       {"friction", ConeSizes::friction},
                                       {"force", ConeSizes::force}},
                                      ConeSizes::apart);
  if (showing.cone_sizes == ConeSizes::force && given.forces.empty())
    fail("{}: cones: 'force' needs the option forces", options.subject());
  showing.cone_height = options.number("cone_height", 0);
  showing.loads = read_loads(given);
  showing.framing = options.choice(
      "frame", {{"contacts", Framing::contacts}, {"all", Framing::all}}, Framing::contacts);
}

// true, false, or the height of the floor
static void read_ground(lua_State* L, Table& options, SceneOptions& showing) {
  const int type = options.push("ground");
  if (type == LUA_TNUMBER && std::isfinite(lua_tonumber(L, -1)))
    showing.ground_height = lua_tonumber(L, -1);
  else if (type == LUA_TBOOLEAN)
    showing.ground = lua_toboolean(L, -1);
  else if (type != LUA_TNIL)
    fail_expected(options.what("ground"), "true, false, or the height of the floor in meters", -1);
  lua_pop(L, 1);
}

// calls f with each item of a list, which is on top of the stack
template <class F>
static void for_items(lua_State* L, Table& options, const char* key, const char* expected, F f) {
  if (options.push(key) != LUA_TNIL) {
    if (!lua_istable(L, -1)) fail_expected(options.what(key), expected, -1);
    const int list = lua_gettop(L), count = static_cast<int>(lua_rawlen(L, list));
    for (int i = 1; i <= count; ++i) {
      lua_rawgeti(L, list, i);
      f(options.what(key).item(i));
      lua_settop(L, list);
    }
  }
  lua_pop(L, 1);
}

static void add_ghosts(lua_State* L, Table& options, Scene& scene) {
  for_items(L, options, "ghosts", "a list of ghosts", [&](const What& what) {
    Table item(L, lua_gettop(L), what.text());
    const auto* robot = item.object<RobotHandle>("robot");
    if (!robot) fail_expected(item.what("robot"), "a robot", lua_gettop(L) + 1);
    const Eigen::Vector3d color = item.vec3("color", palette::ghost.cast<double>());
    if (!(color.minCoeff() >= 0 && color.maxCoeff() <= 1))
      fail("{}: expected three numbers from 0 to 1", item.what("color").text());
    item.done();
    add_ghost(*robot->world, robot->id, color.cast<float>(), scene);
  });
}

static void add_wrenches(lua_State* L, Table& options, Scene& scene) {
  for_items(L, options, "wrenches", "a list of wrenches", [&](const What& what) {
    Table item(L, lua_gettop(L), what.text());
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    add_wrench({item.vec3("point"), item.vec3("force", zero), item.vec3("torque", zero)}, scene);
    item.done();
  });
}

Scene read_scene(lua_State* L, Table& options, std::span<const World* const> states) {
  SceneOptions showing;
  showing.patches = options.boolean("patches", showing.patches);
  showing.contacts = options.boolean("contacts", !showing.patches);
  read_ground(L, options, showing);
  showing.transparent_objects = options.boolean("transparent_objects", showing.transparent_objects);
  showing.file_colors = options.boolean("file_colors", showing.file_colors);
  showing.approach = options.boolean("approach", showing.approach);
  GivenForces given = read_forces(L, options);
  read_cones(options, given, showing);
  const bool arrows = options.boolean("arrows", true);
  if (!arrows) given.forces.clear(), given.contacts.clear(), given.robots.clear();
  showing.see_through = std::move(given.robots);
  Scene scene = make_film_scene(states, showing);
  add_forces(options, given, scene);
  add_ghosts(L, options, scene);
  add_wrenches(L, options, scene);
  return scene;
}

}  // namespace clench
