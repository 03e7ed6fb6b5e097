#include "clench/script/bind/read_spec.h"

#include "clench/base/error.h"

namespace clench {

// a folder for all packages, or a table of names and folders
static void read_packages(lua_State* L, Table& options, ReadOptions& reading) {
  const std::string subject = options.subject() + ": package";
  const int type = options.push("package");
  if (type == LUA_TSTRING) {
    reading.packages[""] = check_folder(options.string("package"), subject);
  } else if (type == LUA_TTABLE) {
    each_named(L, -1, {L, subject, {}}, "names of packages",
               [&](const std::string& name, int i, const What& what) {
                 if (lua_type(L, i) != LUA_TSTRING) fail_expected(what, "a folder", i);
                 reading.packages[name] = check_folder(read_string(L, i, what), what.text());
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
    const auto sense = [&](int i, const What& what) {
      if (lua_type(L, i) != LUA_TNUMBER) fail_expected(what, "1, -1 or 0", i);
      return lua_tonumber(L, i);
    };
    std::vector<int> numbers;
    const auto by_name = [&](const std::string& name, int i, const What& what) {
      reading.closing[name] = sense(i, what);
    };
    each_named(L, -1, {L, subject, {}}, "names or numbers", by_name, &numbers);
    for (const int number : numbers) {
      lua_rawgeti(L, -1, number);
      reading.closing_by_number[number] =
          sense(lua_gettop(L), {L, subject, std::to_string(number)});
      lua_pop(L, 1);
    }
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
