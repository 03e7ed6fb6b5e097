#include "clench/script/lua/chunks.h"

#include <filesystem>
#include <fstream>

#include "clench/script/host/state.h"
#include "script_state.h"
#include "support/folder.h"

using clench::State;
using clench::test::Script;
namespace fs = std::filesystem;

namespace {

/// A compiled chunk in a file, removed afterwards.
class Compiled {
 public:
  Compiled() {
    Script lua;
    const std::string bytes = lua.text("string.dump(load 'return 42')");
    std::ofstream(path_, std::ios::binary) << bytes;
    std::ofstream(marked(), std::ios::binary) << "#!/usr/bin/lua\n" << bytes;
  }
  std::string name() const { return path_.string(); }
  std::string marked() const { return path_.string() + ".marked"; }

 private:
  clench::test::TemporaryFolder folder_;
  fs::path path_ = folder_.path() / "chunk.lua";
};

// the claims about load and similar functions, as a chunk that fails if one does not hold
constexpr const char* claims = R"lua(
  local path, marked = ...
  local bytes = string.dump(function() return 42 end)
  local function refused(name, f, message)
    assert(f == nil and message == name .. ": bytecode is not run; expected Lua text", message)
  end
  refused("load", load(bytes))
  refused("load", load(bytes, nil, "b"))
  refused("load", load(bytes, bytes, "bt", {}))
  refused("mine", load(bytes, "=mine"))
  refused("mine.lua", load(bytes, "@mine.lua", "b", _ENV))
  local at = 0
  local function bytewise()
    at = at + 1
    return bytes:sub(at, at)
  end
  refused("(load)", load(bytewise))
  at = 0
  refused("(load)", load(bytewise, nil, "b"))
  refused("load", load("return 1", nil, "b"))
  for _, file in ipairs {path, marked} do
    refused(file, loadfile(file))
    refused(file, loadfile(file, "b"))
    local ok, message = pcall(dofile, file)
    assert(not ok and message == file .. ": bytecode is not run; expected Lua text")
  end
  package.path = path
  local ok, message = pcall(require, "anything")
  assert(not ok and message:find(path .. ": bytecode is not run; expected Lua text", 1, true), message)
  for _, search in ipairs(package.searchers) do
    local found, loader = pcall(search, "anything")
    assert(not (found and type(loader) == "function"))
  end
  -- text is taken as ever
  assert(load "return 1"() == 1 and load("return x", "=x", "t", {x = 2})() == 2)
  assert(load("return x", nil, nil, nil) and not pcall(load("return x", nil, nil, nil)))
  local parts = {"return ", "3", nil}
  at = 0
  assert(load(function() at = at + 1 return parts[at] end)() == 3)
  assert(select(2, load "x = = 1") == '[string "x = = 1"]:1: unexpected symbol near \'=\'')
  assert(select(2, load(function() error("mine", 0) end)):find "^mine")
  assert(select(2, load(function() return {} end)):find "must return a string")
  assert(not pcall(load) and not pcall(load, {}))
  assert(select(2, loadfile "no/such.lua"):find "cannot open no/such.lua"))lua";

void write_text(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

}  // namespace

TEST_CASE("a compiled chunk is rejected wherever it could be loaded, with its file's name") {
  const Compiled compiled;
  State state;
  const std::string file = compiled.name() + ".claims";
  write_text(file, claims);
  const auto result = state.run_file(file, {compiled.name(), compiled.marked()});
  fs::remove(file);
  CHECK_MESSAGE(result.ok, result.error);
  CHECK(state.run_file(compiled.name(), {}).error ==
        compiled.name() + ": bytecode is not run; expected Lua text");
}

TEST_CASE("a world in Lua that is a compiled chunk is rejected in every state") {
  const Compiled compiled;
  Script lua;
  CHECK(lua.text("clench.load '" + compiled.name() + "'") ==
        "test:1: " + compiled.name() + ": bytecode is not run; expected Lua text");
}

TEST_CASE("a host's state rejects bytecode on request, before or after Clench is opened") {
  const Compiled compiled;
  for (const bool before : {true, false}) {
    CAPTURE(before);
    lua_State* L = luaL_newstate();
    luaL_openlibs(L);
    const auto refuse = [L] {
      lua_pushcfunction(L, clench_refuse_bytecode);
      CHECK(lua_pcall(L, 0, 0, 0) == LUA_OK);
    };
    if (before) refuse();
    luaL_requiref(L, "clench", clench_open, 0);
    lua_pop(L, 1);
    if (!before) refuse();
    REQUIRE(luaL_loadstring(L, claims) == LUA_OK);
    lua_pushstring(L, compiled.name().c_str());
    lua_pushstring(L, compiled.marked().c_str());
    const bool ok = lua_pcall(L, 2, 0, 0) == LUA_OK;
    CHECK_MESSAGE(ok, (ok ? "" : lua_tostring(L, -1)));
    lua_close(L);
  }
}

TEST_CASE(
    "a host that requests this too late gets an error, and without the request Lua's own load is "
    "kept") {
  Script lua;
  CHECK(lua.text("load(string.dump(load 'return 42'))()") == "42");
  lua.run("table.insert(package.searchers, 1, print)");
  lua_pushcfunction(lua.L, clench_refuse_bytecode);
  CHECK(lua_pcall(lua.L, 0, 0, 0) != LUA_OK);
  CHECK(std::string(lua_tostring(lua.L, -1)) ==
        "clench_refuse_bytecode: expected package.searchers as Lua makes them");
}
