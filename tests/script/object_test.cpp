#include "clench/script/lua/object.h"

#include "clench/script/lua/check.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "script_state.h"

using namespace clench;
using clench::test::Script;

namespace {

int living = 0;

// not trivial, and with a larger alignment than Lua provides
struct alignas(64) Probe {
  explicit Probe(int n) : number(n) { ++living; }
  Probe(Probe&& other) noexcept : number(other.number) { ++living; }
  ~Probe() { --living; }
  int number;
};

// declares that it owns a megabyte
struct Heavy {
  Heavy() { ++living; }
  Heavy(Heavy&&) noexcept { ++living; }
  ~Heavy() { --living; }
};
size_t owned_bytes(const Heavy&) { return 1 << 20; }

extern const Class probe_class, child_class, heavy_class;
struct Child {
  int number;
};

}  // namespace

namespace clench {
template <>
const Class& class_of<Probe>() {
  return probe_class;
}
template <>
const Class& class_of<Child>() {
  return child_class;
}
template <>
const Class& class_of<Heavy>() {
  return heavy_class;
}
}  // namespace clench

namespace {

int get_number(lua_State* L) {
  if (to<Child>(L, 1)) return push(L, self<Child>(L).number);
  return push(L, self<Probe>(L).number);
}
int set_number(lua_State* L) {
  self<Probe>(L).number = check_int(L, 2);
  return 0;
}
int twice(lua_State* L) { return push(L, 2 * self<Probe>(L).number); }
int who(lua_State* L) { return push(L, subject(L)); }

const Entry fields[] = {{"number", guarded<get_number>, "", guarded<set_number>},
                        {"who_field", guarded<who>, ""}};
const Entry methods[] = {{"twice", guarded<twice>, ""}, {"who", guarded<who>, ""}};
const Entry child_methods[] = {{"twice", guarded<who>, ""}};
const Class probe_class{
    .name = "probe", .variable = "tip", .doc = "", .fields = fields, .methods = methods};
const Class child_class{.name = "child",
                        .variable = "kid",
                        .doc = "",
                        .fields = {},
                        .methods = child_methods,
                        .operators = {},
                        .parent = &probe_class};

int make_probe(lua_State* L) { return push_object(L, Probe(check_int(L, 1))); }
const Class heavy_class{
    .name = "heavy", .variable = "heavy", .doc = "", .fields = {}, .methods = {}};
int make_heavy(lua_State* L) { return push_object(L, Heavy()); }
int make_child(lua_State* L) { return push_object(L, Child{check_int(L, 1)}); }

struct Probes : Script {
  Probes() {
    lua_register(L, "probe", guarded<make_probe>);
    lua_register(L, "child", guarded<make_child>);
    lua_register(L, "heavy", guarded<make_heavy>);
    lua_register(L, "living", [](lua_State* state) {
      lua_pushinteger(state, living);
      return 1;
    });
  }
};

}  // namespace

TEST_CASE("fields are read and set, methods called, by name") {
  Probes lua;
  CHECK(lua.run("local p = probe(4) p.number = p.number + 1 return p.number, p:twice()") ==
        "5, 10");
  CHECK(lua.run("probe(4).number = 'x'") == "test:1: tip.number: expected an integer, got 'x'");
  CHECK(lua.run("probe(4).who_field = 1") ==
        "test:1: tip.who_field cannot be set: it is read only");
  CHECK(lua.run("probe(4).numbr = 1") ==
        "test:1: tip has no field 'numbr' to set; did you mean 'number'?");
  CHECK(lua.run("return probe(4).twise") == "test:1: tip has no 'twise'; did you mean 'twice'?");
  CHECK(lua.run("return probe(4)[1]").find("expected a name") != std::string::npos);
}

TEST_CASE("an entry knows its name") {
  Probes lua;
  CHECK(lua.run("local p = probe(4) return p:who(), p.who_field") == "tip:who, tip.who_field");
}

TEST_CASE(
    "a class inherits its parent's fields and methods, under its own name, and may replace them") {
  Probes lua;
  CHECK(lua.run("local c = child(3) return c.number, c:who(), c:twice()") ==
        "3, kid:who, kid:twice");
}

TEST_CASE("values are destroyed exactly once: by the collector, or by <close>") {
  {
    Probes lua;
    CHECK(lua.run("for i = 1, 100 do probe(i) end collectgarbage() collectgarbage()") == "");
    CHECK(living == 0);
    CHECK(lua.run("kept = nil do local p <close> = probe(1) kept = p end return pcall(function() "
                  "return kept.number end)")
              .find("tip.number: the probe was closed") != std::string::npos);
    CHECK(lua.run("local w, s = clench.world() do local t <close> = w:snapshot() s = t end "
                  "return pcall(w.restore, w, s)") ==
          "false, test:1: world:restore: snapshot: expected a snapshot, got one that was closed");
    CHECK(living == 0);
    // the finalizer, called directly, twice and with foreign values
    CHECK(lua.run("local p = probe(1) local gc = debug.getmetatable(p).__gc gc(p) gc(p) gc(1) gc() "
                  "gc(io.stdout)") == "");
    CHECK(living == 0);
    lua.run("still_here = probe(2)");
    CHECK(living == 1);
  }
  CHECK(living == 0);
}

TEST_CASE("the metatable of a class does not make a foreign value an object of the class") {
  Probes lua;
  CHECK(lua.run("local v = clench.vec3(1, 2, 3) debug.setmetatable(v, "
                "debug.getmetatable(probe(1))) return v.number")
            .find("tip.number: expected a probe") == std::string::npos);
  // both have a class's metatable, but not its contents
  CHECK(lua.run("local v = clench.vec3(1, 2, 3) debug.setmetatable(v, "
                "debug.getmetatable(probe(1))) return v:twice()")
            .find("closed") != std::string::npos);
  CHECK(lua.run("local f = io.tmpfile() debug.setmetatable(f, debug.getmetatable(clench.pose())) "
                "return f:angle()")
            .find("pose:angle") != std::string::npos);
  CHECK(lua.run("return getmetatable(probe(1))") == "probe");
}

TEST_CASE("the storage has the alignment of its type") {
  Probes lua;
  lua.run("p = {} for i = 1, 50 do p[i] = probe(i) end");
  lua_settop(lua.L, 0);
  lua_getglobal(lua.L, "p");
  for (int i = 1; i <= 50; ++i) {
    lua_rawgeti(lua.L, 1, i);
    auto* probe = to<Probe>(lua.L, -1);
    REQUIRE(probe);
    CHECK(reinterpret_cast<uintptr_t>(probe) % 64 == 0);
    CHECK(probe->number == i);
    lua_pop(lua.L, 1);
  }
}

TEST_CASE("memory owned by values is collected although Lua does not see it") {
  Probes lua;
  const std::string loop =
      "local most = 0 for i = 1, 500 do local h = heavy() most = math.max(most, living()) end "
      "collectgarbage() return most";
  for (const char* mode : {"incremental", "generational"}) {
    CAPTURE(mode);
    lua.run("collectgarbage '" + std::string(mode) + "'");
    // up to 64 MB accumulate, and up to twice Lua's own memory
    CHECK(std::stoi(lua.run(loop)) <= 70);
    CHECK(living == 0);
  }
  // values in use stay, and do not cause a collection with every new value
  CHECK(lua.run("held = {} for i = 1, 300 do held[i] = heavy() end local cycles = 0 "
                "setmetatable({}, {__gc = function(o) cycles = cycles + 1 "
                "setmetatable({}, getmetatable(o)) end}) "
                "for i = 1, 300 do heavy() end return living() >= 300, cycles < 10") ==
        "true, true");
}

TEST_CASE("closed values and a stopped collector cause no collection") {
  Probes lua;
  CHECK(lua.run("collectgarbage 'stop' for i = 1, 200 do heavy() end return living()") == "200");
  CHECK(lua.run("collectgarbage 'restart' heavy() return living()") == "1");
  // closed values own nothing: the others are not collected
  CHECK(lua.run("collectgarbage() for i = 1, 30 do heavy() end "
                "for i = 1, 300 do local h <close> = heavy() end return living()") == "30");
}

TEST_CASE("finalizers that create values during a collection are safe") {
  Probes lua;
  CHECK(lua.run("local n = 0 "
                "for i = 1, 300 do setmetatable({}, {__gc = function() n = n + 1 heavy() error 'x' "
                "end}) heavy() end return n > 0") == "true");
  lua.run("collectgarbage() collectgarbage()");
  CHECK(living == 0);
}
