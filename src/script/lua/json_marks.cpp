#include "clench/script/lua/json.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/push.h"

namespace clench {

// addresses are the registry keys of null and of the empty objects' metatable
static const char null_key = 0, object_key = 0;

static int null_text(lua_State* L) { return push(L, "null"); }

void push_json_null(lua_State* L) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &null_key) == LUA_TUSERDATA) return;
  lua_pop(L, 1);
  lua_newuserdatauv(L, 0, 0);
  lua_newtable(L);
  lua_pushcfunction(L, null_text);
  lua_setfield(L, -2, "__tostring");
  lua_setmetatable(L, -2);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &null_key);
}

void mark_json_object(lua_State* L) {
  if (push_kept_table(L, &object_key)) {
    lua_pushboolean(L, 1);
    lua_setfield(L, -2, "__object");
  }
  lua_setmetatable(L, -2);
}

}  // namespace clench
