// Options that define the variables of a search.
#include "clench/script/bind/planning/planning.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/push.h"

namespace clench {

namespace {

// Calls read(name, index, what) with each value of an option {name = value}.
template <class Read>
void each_variable(lua_State* L, Table& options, const char* key, Read read) {
  const int type = options.push(key);
  if (type == LUA_TTABLE)
    each_named(L, -1, options.what(key), "names of variables", read);
  else if (type != LUA_TNIL)
    fail_expected(options.what(key), "a table by names of variables", lua_gettop(L));
  lua_pop(L, 1);
}

PositionKind read_position(Table& options) {
  return options.choice("position",
                        {{"axis_angle", PositionKind::axis_angle},
                         {"complete", PositionKind::complete},
                         {"ellipsoid", PositionKind::ellipsoid},
                         {"approach", PositionKind::approach},
                         {"fixed", PositionKind::fixed}},
                        PositionKind::axis_angle);
}

PostureKind read_posture(Table& options) {
  return options.choice("posture",
                        {{"eigengrasps", PostureKind::eigengrasps},
                         {"dofs", PostureKind::dofs},
                         {"fixed", PostureKind::fixed}},
                        PostureKind::eigengrasps);
}

Variable read_variable(lua_State* L, int i, const std::string& name, const What& what) {
  if (!lua_istable(L, i)) fail_expected(what, "a table of min, max, value, jump", i);
  Table of(L, i, what.text());
  Variable out{.name = name};
  out.min = of.number("min"), out.max = of.number("max");
  out.value = of.number("value", out.min);
  out.jump = of.number("jump", out.max > out.min ? (out.max - out.min) / 2 : 1);
  out.circular = of.boolean("circular", false);
  of.done();
  return out;
}

}  // namespace

SearchSpace read_space(lua_State* L, Table& options, const World& world, const HandAndObject& who) {
  SpaceOptions kinds{.position = read_position(options), .posture = read_posture(options)};
  kinds.semi_axes = options.vec3("semi_axes", kinds.semi_axes);
  const Robot& hand = world.robot(who.hand);
  const HandState start{world.pose(who.object).inverse() * world.pose(hand.base),
                        world.dofs(who.hand)};
  SearchSpace space(hand, start, kinds);
  const auto of = [&](const std::string& name) -> Variable& {
    return space.variables()[find_variable(space.variables(), name)];
  };

  each_variable(L, options, "variables", [&](const std::string& name, int i, const What& what) {
    space.add_variable(read_variable(L, i, name, what));
  });
  each_variable(L, options, "limits", [&](const std::string& name, int i, const What& what) {
    const auto range = read_numbers(L, i, what, 2);
    Variable& v = of(name);
    v.min = range[0], v.max = range[1];
    if (v.min < v.max) v.value = std::clamp(v.value, v.min, v.max);
    v.circular = false;
  });
  each_variable(L, options, "jumps", [&](const std::string& name, int i, const What& what) {
    of(name).jump = read_number(L, i, what);
  });
  if (options.choice("start", {{"default", false}, {"hand", true}}, false)) {
    const Values now = space.values(start);
    for (int i = 0; i < now.size(); ++i)
      space.variables()[i].value =
          std::clamp(now[i], space.variables()[i].min, space.variables()[i].max);
  }
  each_variable(L, options, "values", [&](const std::string& name, int i, const What& what) {
    of(name).value = read_number(L, i, what);
  });
  each_variable(L, options, "targets", [&](const std::string& name, int i, const What& what) {
    const auto target = read_numbers(L, i, what, 2);
    of(name).target = target[0], of(name).confidence = target[1];
  });
  if (options.has("fixed"))
    options.each("fixed", "a list of names",
                 [&](int i, const What& what) { of(read_string(L, i, what)).fixed = true; });
  space.check();
  return space;
}

int push_values(lua_State* L, const SearchSpace& space, const Values& values) {
  push_list(L, 0, static_cast<int>(values.size()));
  for (int i = 0; i < values.size(); ++i)
    set_field(L, space.variables()[i].name.c_str(), values[i]);
  return 1;
}

}  // namespace clench
