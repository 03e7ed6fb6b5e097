#include "clench/script/lua/script_function.h"

#include "clench/script/lua/guard.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/read.h"

namespace clench {

namespace {

struct Current {
  std::shared_ptr<lua_State*> state = std::make_shared<lua_State*>(nullptr);
};

// a function stored in the registry until its last user releases it
struct Reference {
  lua_State* main;
  int number;
  Reference(lua_State* of, int reference) : main(of), number(reference) {}
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;
  ~Reference() { luaL_unref(main, LUA_REGISTRYINDEX, number); }
};

}  // namespace

CallingState::CallingState(lua_State* L) : current_(kept<Current>(L).state), before_(*current_) {
  *current_ = L;
}

std::function<double()> script_number(lua_State* L, int index) {
  lua_pushvalue(L, index);
  const int number = luaL_ref(L, LUA_REGISTRYINDEX);
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_MAINTHREAD);
  lua_State* const main = lua_tothread(L, -1);
  lua_pop(L, 1);
  const auto function = std::make_shared<Reference>(main, number);
  return [function, current = kept<Current>(L).state] {
    lua_State* const now = *current;
    if (!now || !lua_checkstack(now, 4)) fail("a script's function: no script is waiting for it");
    lua_rawgeti(now, LUA_REGISTRYINDEX, function->number);
    call_script(now, 0, 1, "energy");
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
