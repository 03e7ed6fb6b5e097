#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "clench/base/random.h"
#include "script_state.h"
#include "support/folder.h"

using clench::test::Script;
namespace fs = std::filesystem;

TEST_CASE("an unknown name of the module is answered with the nearest name") {
  Script lua;
  CHECK(lua.text("clench.psoe") == "test:1: clench has no 'psoe'; did you mean 'pose'?");
  CHECK(lua.text("clench.json.encod") ==
        "test:1: clench.json has no 'encod'; did you mean 'encode'?");
  CHECK(lua.text("rawget(clench, 'psoe')") == "nil");
}

TEST_CASE("the standard library is the same by field and by require") {
  Script lua;
  CHECK(lua.text("clench.show == require 'clench.show'") == "true");
  CHECK(lua.text("require 'clench.show' == clench.show") == "true");
  CHECK(lua.text("clench.show{1, {2}}") == "{1, {2}}");
  const auto message = lua.text("require 'clench.nothing'");
  CHECK(message.find("no module 'clench.nothing' in clench's standard library") !=
        std::string::npos);
  // bare names exist in the command only
  CHECK(lua.text("pcall(require, 'show')").starts_with("false"));
}

TEST_CASE("a state without the standard libraries still opens") {
  lua_State* L = luaL_newstate();
  lua_pushcfunction(L, clench_open);
  REQUIRE(lua_pcall(L, 0, 1, 0) == LUA_OK);
  lua_getfield(L, -1, "version");
  CHECK(lua_isstring(L, -1));
  lua_close(L);
}

TEST_CASE("two states are independent of each other") {
  Script a, b;
  a.run("rawset(clench, 'pose', 1)  clench.log.level 'quiet'");
  CHECK(b.text("clench.pose{}.position") == "(0, 0, 0)");
  CHECK(b.text("clench.log.level()") == "info");
}

TEST_CASE("random numbers are the engine's own") {
  Script lua;
  clench::Random random(5, 3);
  CHECK(lua.text("string.format('%.17g', clench.random(5, 3):uniform())") ==
        fmt::format("{:.17g}", random.uniform()));
  CHECK(lua.text("clench.random()") ==
        "test:1: clench.random: seed: expected an integer, got nothing");
  CHECK(lua.text("clench.random(1):uniform(2, 1)") ==
        "test:1: random:uniform: expected low <= high, got 2 and 1");
}

TEST_CASE("random integers include both bounds, also of the widest range") {
  Script lua;
  CHECK(lua.run(R"(
    local r, seen = clench.random(1), {}
    for _ = 1, 200 do seen[r:integer(-1, 2)] = true end
    return seen[-1] and seen[0] and seen[1] and seen[2] and not seen[3] and not seen[-2],
           math.type(r:integer(math.mininteger, math.maxinteger)))") == "true, integer");
}

TEST_CASE("the log is written to the given sink, from the given level") {
  Script lua;
  CHECK(lua.run(R"(
    local said = {}
    clench.log.sink(function(level, text) said[#said + 1] = level .. " " .. text end)
    clench.log.debug "a" clench.log.info("b", 2, nil) clench.log.warning{} clench.log.level "error"
    clench.log.warning "c" clench.log.error "d" clench.log.level "debug" clench.log.debug "e"
    said[2] = said[2]:gsub("0x.*", "")
    return table.concat(said, "|"))") == "info b 2 nil|warning table: |error d|debug e");
  CHECK(lua.text("clench.log.level 'loud'") ==
        "test:1: clench.log.level: expected one of debug, info, warning, error, quiet, got 'loud'");
  CHECK(lua.text("clench.log.sink(3)") ==
        "test:1: clench.log.sink: fn: expected a function or nil, got 3");
  CHECK(lua.run("clench.log.sink(function() error('mine', 0) end) clench.log.error 'x'") == "mine");
  CHECK(lua.run("clench.log.sink() clench.log.info(setmetatable({}, {__tostring = function() "
                "error('text', 0) end}))") == "text");
}

TEST_CASE("the catalog lists the contents of the folder named by CLENCH_MODELS, sorted") {
  const clench::test::TemporaryFolder folder;
  const fs::path home = folder.path();
  for (const char* name :
       {"models/hands/b/b.cfg", "models/hands/a.cfg", "models/hands/a.iv", "models/objects/mug.iv",
        "models/obstacles/table.iv", "models/objects/primitives/mug.iv", "worlds/w.wld",
        "worlds/readme.md"}) {
    fs::create_directories((home / name).parent_path());
    std::ofstream(home / name) << "x";
  }
  setenv("CLENCH_MODELS", home.c_str(), 1);
  Script lua;
  const auto list = lua.run(R"(
    local c, text = clench.catalog(), {}
    for _, shelf in ipairs{"hands", "arms", "objects", "obstacles", "worlds"} do
      local names = {}
      for i, path in ipairs(c[shelf]) do names[i] = path:match "[^/]+$" end
      text[#text + 1] = shelf .. ":" .. table.concat(names, ",")
    end
    return table.concat(text, " "))");
  CHECK(list == "hands:a.cfg,b.cfg arms: objects:mug.iv obstacles:table.iv worlds:w.wld");
  unsetenv("CLENCH_MODELS");
}
