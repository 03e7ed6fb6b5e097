// Uses the engine as a library, and passes it a Lua state.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <lua.hpp>

#include <clench/clench.h>

static void require(bool ok, const char* claim) {
  if (ok) return;
  std::printf("failed: %s\n", claim);
  std::exit(1);
}

static void use_engine() {
  const auto turn = clench::Pose::turn(0.5, Eigen::Vector3d::UnitZ());
  require(std::abs((turn.inverse() * turn).angle()) < 1e-15, "a pose and its inverse cancel");
  clench::World world;
  try {
    world.set_contact_threshold(-1);
    require(false, "a negative threshold is refused");
  } catch (const clench::Error& e) {
    require(std::strstr(e.what(), "-1"), "the refusal says what it got");
  }
}

// the state belongs to the host: its globals, libraries and functions stay unchanged
static void lend_lua() {
  lua_State* L = luaL_newstate();
  luaL_openlibs(L);
  lua_pushcfunction(L, clench_refuse_bytecode);
  lua_call(L, 0, 0);
  luaL_requiref(L, "clench", clench_open, 0);
  lua_pop(L, 1);
  const char* script = R"(
    assert(_G.clench == nil)
    assert(not load(string.dump(function() end)))
    local clench = require "clench"
    assert((clench.pose{xyz = {1, 2, 3}} * {1, 1, 1}).z == 4)
    for _ = 1, 1000 do
      local ok, message = pcall(clench.pose, {xzy = {1, 2, 3}})
      assert(not ok and message:find("did you mean 'xyz'?", 1, true))
    end
    assert(#clench.shapes.sphere{1, subdivisions = 0}.triangles == 20)
    return clench.version)";
  const bool ok = luaL_dostring(L, script) == LUA_OK;
  if (!ok) std::printf("%s\n", luaL_tolstring(L, -1, nullptr));
  require(ok && lua_isstring(L, -1), "a script runs in the host's Lua");
  lua_close(L);
}

int main() {
  use_engine();
  lend_lua();
  lend_lua();  // a second state is independent
  std::puts("the host is content");
}
