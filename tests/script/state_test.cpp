#include "clench/script/host/state.h"
#include "support/folder.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

using clench::State;
namespace fs = std::filesystem;

static std::string error_of(State& state, const std::string& code) {
  return state.run_code(code, "=test").error;
}

static bool says(const std::string& text, const std::string& part) {
  const bool found = text.find(part) != std::string::npos;
  if (!found) MESSAGE("expected '", part, "' in: ", text.substr(0, 400));
  return found;
}

TEST_CASE("an error has message and traceback for any error value") {
  State state;
  CHECK(says(error_of(state, "local function f() error 'no' end f()"),
             "test:1: no\nstack traceback:"));
  CHECK(says(error_of(state, "error{code = 3}"), "error object is the table {code = 3}"));
  CHECK(says(error_of(state, "error()"), "error object is a nil value"));
  CHECK(says(error_of(state, "error(true)"), "error object is a boolean value"));
  CHECK(says(error_of(state, "error(print)"), "error object is a function value"));
  CHECK(
      says(error_of(state, "error(setmetatable({}, {__tostring = function() return 'mine' end}))"),
           "mine\nstack"));
  CHECK(says(error_of(state, "return +"), "unexpected symbol"));
  CHECK(says(error_of(state, "error(setmetatable({}, {__tostring = function() error 'no' end}))"),
             "error object is a table whose __tostring fails\nstack traceback:"));
  CHECK(says(error_of(state, "error('a\\0b', 0)"), std::string("a\0b\nstack", 9)));
  CHECK(state.run_code("return 1", "=test").ok);
}

TEST_CASE("no script ends the process: recursion, memory, patterns, finalizers, yields") {
  State state;
  state.set_quiet();
  CHECK(says(error_of(state, "local function f() return f() + 1 end f()"), "stack overflow"));
  CHECK(
      says(error_of(state, "local t = setmetatable({}, {}) getmetatable(t).__index = t return t.x"),
           "loop"));
  CHECK(says(error_of(state, "return io.tmpfile():read(1 << 42)"), "not enough memory"));
  CHECK(says(error_of(state, "return ('x'):rep(1 << 62)"), ""));
  CHECK(says(error_of(state, "string.rep('x', math.maxinteger, 'y')"), "too large"));
  CHECK(says(error_of(state, "return ('('):rep(300):find(('('):rep(300))"), ""));
  CHECK(says(error_of(state, "coroutine.yield()"), "outside a coroutine"));
  CHECK(says(error_of(state, "table.concat(setmetatable({}, {__len = function() return 1e9 end}))"),
             "invalid value"));
  CHECK(state
            .run_code("setmetatable({}, {__gc = function() error 'in gc' end}) collectgarbage()",
                      "=test")
            .ok);
  CHECK(says(
      error_of(state,
               "local x <close> = setmetatable({}, {__close = function() error 'in close' end})"),
      "in close"));
  CHECK(says(error_of(state, "load('x = ' .. ('('):rep(1000) .. '1' .. (')'):rep(1000))() "), ""));
  CHECK(says(error_of(state, "load(string.dump(function() end), 'x', 't')()"), ""));
  CHECK(
      says(error_of(state, "string = nil print = nil error 'still explained'"), "still explained"));
}

TEST_CASE("a finalizer that runs when the state closes may fail") {
  State state;
  state.set_quiet();
  CHECK(state.run_code("x = setmetatable({}, {__gc = function() error 'at the end' end})", "=test")
            .ok);
}

TEST_CASE("a file gets its arguments as arg and as ...") {
  const clench::test::TemporaryFolder folder;
  const fs::path path = folder.path() / "state_test.lua";
  std::ofstream(path) << "local a, b = ... return arg[0], arg[1], arg[2], #arg, a, b";
  State state;
  const auto result = state.run_file(path.string(), {"one", "--two"});
  CHECK(result.ok);
  CHECK(result.values ==
        std::vector<std::string>{path.string(), "one", "--two", "number", "one", "--two"});
  fs::remove(path);
  CHECK(says(state.run_file(path.string(), {}).error, "cannot open " + path.string()));
}

TEST_CASE("a file that is not Lua is rejected, compiled chunks included") {
  const clench::test::TemporaryFolder folder;
  const fs::path path = folder.path() / "state_binary.lua";
  std::ofstream(path, std::ios::binary) << "\x1bLua rubbish";
  State state;
  CHECK(says(state.run_file(path.string(), {}).error, "bytecode is not run; expected Lua text"));
  fs::remove(path);
}

TEST_CASE("clench is a global and a module, and the standard library has bare names") {
  State state;
  CHECK(state
            .run_code("assert(clench == require 'clench') assert(require 'show' == clench.show)",
                      "=test")
            .ok);
  CHECK(says(error_of(state, "clench.grsp()"), "clench has no 'grsp'"));
}

TEST_CASE("the console runs expressions and statements, and detects unfinished ones") {
  State state;
  using Line = State::Line;
  CHECK(state.evaluate("x = 5") == Line::done);
  CHECK(state.evaluate("local y = 1 return y") == Line::done);
  CHECK(state.evaluate("") == Line::done);
  CHECK(state.evaluate("for i = 1, 2 do") == Line::incomplete);
  CHECK(state.evaluate("x = {") == Line::incomplete);
  CHECK(state.evaluate("s = [[a") == Line::incomplete);
  CHECK(state.run_code("assert(x == 5)", "=test").ok);
}

// runs code that never ends, and interrupts it
static State::Result interrupted(State& state, const std::string& code) {
  std::atomic<bool> done = false;
  std::thread watch([&] {
    // an interrupt before the chunk runs is lost, so it is repeated
    while (!done) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (!done) state.interrupt();
    }
  });
  const auto result = state.run_code(code, "=test");
  done = true;
  watch.join();
  return result;
}

TEST_CASE("an interrupt ends an endless loop, also in coroutines and protected calls") {
  State state;
  for (const char* code :
       {"while true do end", "coroutine.wrap(function() while true do end end)()",
        "assert(coroutine.resume(coroutine.create(function() while true do end end)))",
        "for _ in coroutine.wrap(function() while true do coroutine.yield(1) end end) do end",
        "while true do pcall(function() while true do end end) end",
        "while true do xpcall(function() while true do end end, function(e) return e end) end",
        "local f = coroutine.wrap(function() while true do pcall(error) end end) while true do "
        "pcall(f) end"}) {
    const auto result = interrupted(state, code);
    CHECK(!result.ok);
    CHECK(says(result.error, "interrupted"));
  }
  CHECK(state.run_code("local n = 0 for i = 1, 1e5 do n = n + i end", "=test").ok);
}

TEST_CASE("a script that catches an interrupt has half a second to end") {
  State state;
  // from a thread, because Ctrl-C comes at any time
  std::thread once([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    state.interrupt();
  });
  const auto result = state.run_code(
      "local ok, e = pcall(function() while true do end end) "
      "local sum = 0 for i = 1, 1e5 do sum = sum + i end kept = e.kind .. sum",
      "=test");
  once.join();
  CHECK_MESSAGE(result.ok, result.error);
  CHECK(state.run_code("assert(kept == 'stopped5000050000', kept)", "=test").ok);
  std::thread again([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    state.interrupt();
  });
  const auto loop =
      state.run_code("while true do pcall(function() while true do end end) end", "=test");
  again.join();
  CHECK(says(loop.error, "interrupted"));
}

TEST_CASE("an interrupt ends long calls of the engine") {
  State state;
  const std::string ball = R"(
    local clench, contacts = require "clench", {}
    local random = clench.random(1)
    for i = 1, 400 do
      local p = random:direction()
      contacts[i] = {point = p, normal = -p, mu = 0.5}
    end
    local space = clench.wrench_space {contacts = contacts, edges = 8}
  )";
  // each would take seconds, and then end with a different result
  for (const char* code :
       {"space:volume()", "clench.wrench_space {contacts = contacts, edges = 'exact'}:volume()",
        "clench.render(clench.world(), {size = {4000, 4000}, samples = 60}) error 'done'"}) {
    const auto result = interrupted(state, ball + code);
    CHECK(!result.ok);
    CHECK_MESSAGE(says(result.error, "interrupted"), result.error);
  }
  CHECK(state.run_code("assert(require('clench').rad(180) == math.pi)", "=test").ok);
  const auto caught = interrupted(
      state,
      ball + "local ok, e = pcall(space.volume, space) assert(e.kind == 'stopped', e) error(e)");
  CHECK(says(caught.error, "interrupted"));
}

TEST_CASE("a script that catches the interruption of the engine cannot let it work again") {
  // each call lasts many seconds
  const std::string begin = R"(
    local clench, calls = require "clench", 0
    local function work()
      calls = calls + 1
      clench.render(clench.world(), {size = {4000, 4000}, samples = 60})
    end)";
  for (const char* code :
       {"while true do pcall(work) end", "pcall(work) pcall(work) pcall(work) error 'not ended'",
        "local f = coroutine.wrap(function() while true do pcall(work) coroutine.yield() end end) "
        "while true do pcall(f) end",
        // a coroutine that waits at the interruption
        "local inner = coroutine.wrap(function() while true do pcall(work) coroutine.yield() end "
        "end)"
        "local outer = coroutine.wrap(function() while true do pcall(inner) end end) outer()"}) {
    State state;
    std::thread once([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      state.interrupt();
    });
    const auto began = std::chrono::steady_clock::now();
    const auto result = state.run_code(begin + "\n" + code, "=test");
    once.join();
    CHECK(!result.ok);
    CHECK_MESSAGE(says(result.error, "interrupted"), result.error);
    CHECK(std::chrono::steady_clock::now() - began < std::chrono::seconds(30));
  }
}

TEST_CASE("interrupted parallel work reports its results before the error propagates") {
  State state;
  std::thread once([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    state.interrupt();
  });
  // the first item never ends, and the others have ended by then
  const auto result = state.run_code(R"(
    told = {}
    require("clench").parallel.map(function(i) while i == 1 do end return i end, {1, 2, 3, 4, 5},
      {threads = 2, each = function(r, i) told[i] = r end}))",
                                     "=test");
  once.join();
  CHECK(!result.ok);
  CHECK(says(result.error, "interrupted"));
  const auto told = state.run_code(
      "for i = 2, 5 do assert(told[i] == i, told[i]) end assert(told[1].kind == 'stopped', "
      "told[1].error)",
      "=test");
  CHECK_MESSAGE(told.ok, told.error);
}

TEST_CASE("apart from interrupts, coroutines behave as in Lua") {
  State state;
  const auto result = state.run_code(R"(
    local co = coroutine.create(function(a) local b = coroutine.yield(a + 1) return b * 2 end)
    assert(select(2, coroutine.resume(co, 1)) == 2 and select(2, coroutine.resume(co, 5)) == 10)
    local ok, message = coroutine.resume(co)
    assert(not ok and message == "cannot resume dead coroutine")
    assert(not pcall(coroutine.resume, 5))
    local gen = coroutine.wrap(function() for i = 1, 3 do coroutine.yield(i, nil) end end)
    assert(gen() == 1 and select("#", gen()) == 2 and gen() == 3)
    local e = {}
    local good, bad = pcall(coroutine.wrap(function() error(e) end))
    assert(not good and bad == e)
    local inner
    inner = coroutine.wrap(function() return inner() end)
    local fine, why = pcall(inner)
    assert(not fine and why:find "non%-suspended", why)
    good, bad = pcall(coroutine.wrap(function() error "text" end))
    assert(not good and bad:find "test:%d+: text$", bad)
    assert(coroutine.isyieldable() == false)
  )",
                                     "=test");
  CHECK_MESSAGE(result.ok, result.error);
}
