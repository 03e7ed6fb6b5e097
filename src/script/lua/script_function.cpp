#include "clench/script/lua/script_function.h"

#include <new>

#include "clench/script/lua/guard.h"
#include "clench/script/lua/read.h"

namespace clench {

namespace {

using Current = std::shared_ptr<lua_State*>;

// its address names the place of the state's Current
const char current_key = 0;

int drop_current(lua_State* L) {
  static_cast<Current*>(lua_touserdata(L, 1))->~Current();
  return 0;
}

const Current& current_of(lua_State* L) {
  const bool known = lua_rawgetp(L, LUA_REGISTRYINDEX, &current_key) == LUA_TUSERDATA;
  auto* held = static_cast<Current*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  if (known) return *held;
  held = new (lua_newuserdatauv(L, sizeof(Current), 0)) Current();
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, drop_current);
  lua_setfield(L, -2, "__gc");
  lua_setmetatable(L, -2);
  *held = std::make_shared<lua_State*>(nullptr);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &current_key);
  return *held;
}

// a function kept in the registry until nobody wants it
struct Reference {
  lua_State* main;
  int number;
  Reference(lua_State* of, int reference) : main(of), number(reference) {}
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;
  ~Reference() { luaL_unref(main, LUA_REGISTRYINDEX, number); }
};

}  // namespace

CallingState::CallingState(lua_State* L) : current_(current_of(L)), before_(*current_) {
  *current_ = L;
}

std::function<double()> script_number(lua_State* L, int index) {
  lua_pushvalue(L, index);
  const int number = luaL_ref(L, LUA_REGISTRYINDEX);
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_MAINTHREAD);
  lua_State* const main = lua_tothread(L, -1);
  lua_pop(L, 1);
  const auto kept = std::make_shared<Reference>(main, number);
  return [kept, current = current_of(L)] {
    lua_State* const now = *current;
    if (!now || !lua_checkstack(now, 4)) fail("a script's function: there is no script that waits");
    lua_rawgeti(now, LUA_REGISTRYINDEX, kept->number);
    protected_call(now, 0, 1);
    if (lua_type(now, -1) != LUA_TNUMBER) {
      const std::string got = described(now, -1);
      lua_pop(now, 1);
      fail("energy: expected a function that gives a number, got {}", got);
    }
    const double value = lua_tonumber(now, -1);
    lua_pop(now, 1);
    return value;
  };
}

}  // namespace clench
