#include "clench/script/lua/script_place.h"

#include <cstring>

namespace clench {

static constexpr const char* library = "@stdlib/";

void push_script_place(lua_State* L) {
  lua_Debug info;
  for (int level = 0; lua_getstack(L, level, &info); ++level) {
    lua_getinfo(L, "Sl", &info);
    if (info.currentline <= 0 || std::strncmp(info.source, library, std::strlen(library)) == 0)
      continue;
    lua_pushfstring(L, "%s:%d: ", info.short_src, info.currentline);
    return;
  }
  lua_pushliteral(L, "");
}

}  // namespace clench
