#include "script/object.h"

#include "base/error.h"
#include "script/check.h"

namespace clench {

bool has_class(lua_State* L, int index, const Class& kind) {
  if (lua_type(L, index) != LUA_TUSERDATA || !lua_getmetatable(L, index)) return false;
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kind);
  const bool same = lua_rawequal(L, -1, -2);
  lua_pop(L, 2);
  return same;
}

void fail_self(lua_State* L, const Class& kind) {
  const std::string name = subject(L);
  const bool closed = has_class(L, 1, kind);
  if (closed) fail("{}: the {} was closed", name, kind.name);
  const bool method = name.find(':') != std::string::npos;
  fail("{}: wanted {}{}, got {}{}", name, with_article(kind.name),
       method ? " before the colon" : "", described(L, 1), method ? "; use " + name + "(...)" : "");
}

void check_count(lua_State* L, int most) {
  const int self = running_class(L) ? 1 : 0;
  const int count = lua_gettop(L) - self;
  if (count > most)
    fail("{}: wanted at most {} argument{}, got {}", subject(L), most, most == 1 ? "" : "s", count);
}

}  // namespace clench
