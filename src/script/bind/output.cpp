#include "clench/script/bind/output.h"

#include <lua.hpp>

#include "clench/io/text/confine.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/setting.h"

namespace clench {

std::string check_output(lua_State* L, int i, const char* name) {
  std::string path = check_string(L, i, name);
  check_target(path, get_setting(L, Setting::confine));
  return path;
}

}  // namespace clench
