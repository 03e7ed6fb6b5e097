#include "clench/script/lua/setting.h"

#include <lua.hpp>

namespace clench {

// their addresses are the registry keys of the texts
static const char setting_keys[3] = {};

static const void* key_of(Setting setting) { return &setting_keys[static_cast<int>(setting)]; }

void push_setting(lua_State* L, Setting setting) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, key_of(setting)) == LUA_TSTRING) return;
  lua_pop(L, 1);
  lua_pushliteral(L, "");
}

std::string get_setting(lua_State* L, Setting setting) {
  push_setting(L, setting);
  std::string text = lua_tostring(L, -1);
  lua_pop(L, 1);
  return text;
}

void set_setting(lua_State* L, Setting setting, const std::string& text) {
  lua_pushlstring(L, text.data(), text.size());
  lua_rawsetp(L, LUA_REGISTRYINDEX, key_of(setting));
}

ScopedSetting::ScopedSetting(lua_State* L, Setting setting, const std::string& text)
    : L_(L), setting_(setting), before_(get_setting(L, setting)) {
  set_setting(L, setting, text);
}

}  // namespace clench
