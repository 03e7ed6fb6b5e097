#include "clench/script/lua/guard.h"

#include <new>
#include <stdexcept>

#include "script_state.h"

using clench::Error;
using clench::guarded;
using clench::test::Script;

namespace {

int alive = 0;
struct Counted {
  Counted() { ++alive; }
  ~Counted() { --alive; }
};

int throws_error(lua_State*) {
  Counted counted;
  clench::fail("flask: expected a mass > 0, got {}", -1);
}

int calls_back(lua_State* L) {
  Counted counted;
  lua_pushvalue(L, 1);
  clench::protected_call(L, 0, 1);
  return 1;
}

int throws_no_memory(lua_State*) { throw std::bad_alloc(); }
int throws_length(lua_State*) { throw std::length_error("vector::_M_default_append"); }
int throws_other(lua_State*) { throw std::runtime_error("it broke"); }

int throws_long(lua_State*) { throw Error("begins" + std::string(10000, 'x') + "\x1b ends"); }

}  // namespace

TEST_CASE(
    "an exception of the engine becomes a Lua error with the script's line, and C++ objects are "
    "destroyed") {
  Script lua;
  lua_register(lua.L, "f", guarded<throws_error>);
  CHECK(lua.run("f()") == "test:1: flask: expected a mass > 0, got -1");
  CHECK(lua.run("\n\nreturn select(2, pcall(function() f() end))") ==
        "test:3: flask: expected a mass > 0, got -1");
  CHECK(alive == 0);
}

TEST_CASE("an error of a script's function passes through C++ unchanged, with any value") {
  Script lua;
  lua_register(lua.L, "f", guarded<calls_back>);
  CHECK(lua.run("return f(function() return 7 end)") == "7");
  CHECK(lua.run("local e = {} return select(2, pcall(f, function() error(e) end)) == e") == "true");
  CHECK(lua.run("return pcall(f, function() error() end)") == "false, nil");
  CHECK(lua.run("return f(function() return f(function() error('deep', 0) end) end)") == "deep");
  CHECK(alive == 0);
}

TEST_CASE("a yield across C++ is an error, not a crash") {
  Script lua;
  lua_register(lua.L, "f", guarded<calls_back>);
  CHECK(lua.run("return coroutine.resume(coroutine.create(function() f(coroutine.yield) end))") ==
        "false, attempt to yield across a C-call boundary");
  CHECK(alive == 0);
}

TEST_CASE("endless recursion through C++ is an error") {
  Script lua;
  lua_register(lua.L, "f", guarded<calls_back>);
  const auto message = lua.run("local function g() return f(g) end return g()");
  CHECK(message.find("overflow") != std::string::npos);
  CHECK(alive == 0);
}

TEST_CASE("a very long message is reduced to its beginning and end, without control characters") {
  Script lua;
  lua_register(lua.L, "f", guarded<throws_long>);
  const auto message = lua.run("f()");
  CHECK(message.size() < 1100);
  CHECK(message.find("begins") != std::string::npos);
  CHECK(message.find("x...x") != std::string::npos);
  CHECK(message.ends_with("x? ends"));
}

TEST_CASE(
    "other exceptions are reported with the entry's name, and lack of memory in one sentence") {
  Script lua;
  const auto thrown = [&](lua_CFunction f) {
    lua_register(lua.L, "f", f);
    return lua.run("f()");
  };
  CHECK(thrown(guarded<throws_no_memory>) == "test:1: clench: not enough memory");
  CHECK(thrown(guarded<throws_length>) == "test:1: clench: not enough memory");
  CHECK(thrown(guarded<throws_other>) == "test:1: clench: it broke");
}
