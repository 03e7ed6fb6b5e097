#include "clench/script/bind/named_list.h"

#include <string>
#include <string_view>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/stack.h"

namespace clench {

// ".name" or ":autograsp" of a class's member; empty if there is none
static std::string member_of(const Class* kind, std::string_view key) {
  for (; kind; kind = kind->parent) {
    for (const Entry& field : kind->fields)
      if (key == field.name) return "." + std::string(key);
    for (const Entry& method : kind->methods)
      if (key == method.name) return ":" + std::string(key);
  }
  return "";
}

enum NameUpvalue { list_name = 1, finder_name = 2, item_class = 3 };

static int no_such_name(lua_State* L) {
  const std::string list = lua_tostring(L, lua_upvalueindex(list_name));
  const std::string key(string_at(L, 2));
  const auto* kind = static_cast<const Class*>(lua_touserdata(L, lua_upvalueindex(item_class)));
  std::string meant;
  const std::string member = member_of(kind, key);
  if (!member.empty()) {
    meant = list + "[1]" + member;
  } else if (key == "n" || key == "count" || key == "length" || key == "size") {
    meant = "#" + list;
  } else {
    meant = std::string(lua_tostring(L, lua_upvalueindex(finder_name))) + "(\"" + key + "\")";
  }
  fail("{} has no {}: it is a list; did you mean {}?", list, in_quotes(key), meant);
}

static int find_name(lua_State* L) {
  if (lua_type(L, 2) == LUA_TSTRING) return guarded<no_such_name>(L);
  return 0;
}

int set_finder(lua_State* L, const char* finder, const Class& kind) {
  const Entry* field = running_entry(L);
  if (push_kept_table(L, field)) {
    // the same for all lists
    lua_getmetatable(L, -2);
    for (const char* event : {"__tostring", "__contents"}) {
      lua_getfield(L, -1, event);
      lua_setfield(L, -3, event);
    }
    lua_pop(L, 1);
    lua_pushstring(L, subject(L).c_str());
    lua_pushstring(L, finder);
    lua_pushlightuserdata(L, const_cast<Class*>(&kind));
    lua_pushcclosure(L, find_name, 3);
    lua_setfield(L, -2, "__index");
  }
  lua_setmetatable(L, -2);
  return 1;
}

}  // namespace clench
