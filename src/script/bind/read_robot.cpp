#include "clench/script/bind/read_spec.h"

#include "clench/base/error.h"

namespace clench {

/// Visits the keys of the table on top of the stack as text, with the value on top.
template <class Visit>
static void each_key(lua_State* L, const std::string& subject, Visit visit) {
  const int table = lua_gettop(L);
  lua_pushnil(L);
  while (lua_next(L, table)) {
    std::string key;
    if (lua_type(L, -2) == LUA_TSTRING)
      key = string_at(L, -2);
    else if (lua_isinteger(L, -2))
      key = std::to_string(lua_tointeger(L, -2));
    else
      fail("{}: expected names or numbers as keys, got a {}", subject, luaL_typename(L, -2));
    visit(key);
    lua_pop(L, 1);
  }
}

static std::filesystem::path check_folder(const std::string& name, const std::string& subject) {
  std::error_code code;
  if (!std::filesystem::is_directory(name, code))
    fail("{}: expected a folder, got '{}'", subject, name);
  return name;
}

// a folder for all packages, or a table of names and folders
static void read_packages(lua_State* L, Table& options, ReadOptions& reading) {
  const std::string subject = options.subject() + ": package";
  const int type = options.push("package");
  if (type == LUA_TSTRING) {
    reading.packages[""] = check_folder(options.string("package"), subject);
  } else if (type == LUA_TTABLE) {
    each_key(L, subject, [&](const std::string& key) {
      if (lua_type(L, -1) != LUA_TSTRING)
        fail("{}: {}: expected a folder, got a {}", subject, key, luaL_typename(L, -1));
      const std::string folder = read_string(L, -1, {L, subject, key});
      reading.packages[key] = check_folder(folder, subject + ": " + key);
    });
  } else if (type != LUA_TNIL) {
    fail_expected(options.what("package"), "a folder or a table of folders", -1);
  }
  lua_pop(L, 1);
}

static void read_closing(lua_State* L, Table& options, ReadOptions& reading) {
  const std::string subject = options.subject() + ": close";
  const int type = options.push("close");
  if (type == LUA_TTABLE) {
    each_key(L, subject, [&](const std::string& key) {
      if (lua_type(L, -1) != LUA_TNUMBER)
        fail("{}: {}: expected 1, -1 or 0, got a {}", subject, key, luaL_typename(L, -1));
      const double sense = lua_tonumber(L, -1);
      if (lua_isinteger(L, -2) && lua_tointeger(L, -2) == static_cast<int>(lua_tointeger(L, -2)))
        reading.closing_by_number[static_cast<int>(lua_tointeger(L, -2))] = sense;
      else
        reading.closing[key] = sense;
    });
  } else if (type != LUA_TNIL) {
    fail_expected(options.what("close"), "a table such as {index = 1, [3] = -1}", -1);
  }
  lua_pop(L, 1);
}

static void read_approach(lua_State* L, Table& options, ReadOptions& reading) {
  const int type = options.push("approach");
  if (type == LUA_TTABLE) {
    Table table(L, lua_gettop(L), options.subject() + ": approach");
    if (table.has("frame")) {
      reading.approach = table.pose("frame");
    } else {
      const Eigen::Vector3d point = table.vec3("point", {0, 0, 0});
      reading.approach = approach_frame(point, table.vec3("direction"));
    }
    table.done();
  } else if (type != LUA_TNIL) {
    fail_expected(options.what("approach"),
                  "a table {point = ..., direction = ...} or {frame = ...}", -1);
  }
  lua_pop(L, 1);
}

void read_robot_options(lua_State* L, Table& options, ReadOptions& reading) {
  const std::string folder = options.string("folder", "");
  if (!folder.empty()) reading.folder = check_folder(folder, options.subject() + ": folder");
  reading.body = options.string("body", "");
  reading.eigengrasps = options.string("eigengrasps", "");
  reading.virtual_contacts = options.string("virtual_contacts", "");
  read_packages(L, options, reading);
  read_closing(L, options, reading);
  read_approach(L, options, reading);
}

}  // namespace clench
