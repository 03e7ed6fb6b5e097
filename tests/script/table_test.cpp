#include "clench/script/lua/table.h"

#include "clench/script/lua/guard.h"
#include "clench/script/lua/members.h"
#include "clench/script/lua/push.h"
#include "script_state.h"

using namespace clench;
using clench::test::Script;

namespace {

int close_hand(lua_State* L) {
  Table t(L, 1, "hand:autograsp");
  const double speed = t.number("speed", 1);
  const int edges = t.integer("edges", 8);
  const bool stop = t.boolean("stop_at_contact", false);
  const auto* norm = t.choice("norm", {{"L1", "L1"}, {"Linf", "Linf"}}, "L1");
  const auto point = t.vec3("point", {0, 0, 0});
  const Pose pose = t.pose("pose", Pose());
  const auto dofs = t.has("dofs") ? t.numbers("dofs", 3) : std::vector<double>();
  const auto rows = t.has("rows") ? t.rows("rows", 2) : std::vector<std::vector<double>>();
  const auto name = t.string("name", "hand");
  const uint64_t seed = t.seed("seed", 0);
  const bool hook = t.push_function("hook");
  lua_pop(L, 1);
  t.done();
  return push(L,
              fmt::format("{} {} {} {} {} {} {} {} {} {} {}", speed, edges, stop, norm, point.z(),
                          pose.position.x(), dofs.size(), rows.size(), name, seed, hook));
}

struct Options : Script {
  Options() { lua_register(L, "f", guarded<close_hand>); }
  // the message without the line
  std::string operator()(const std::string& arguments) {
    auto text = run("return f" + arguments);
    return text.starts_with("test:1: ") ? text.substr(8) : text;
  }
};

}  // namespace

TEST_CASE("missing options keep their defaults, and given ones are read") {
  Options f;
  const std::string defaults = "1 8 false L1 0 0 0 0 hand 0 false";
  CHECK(f("()") == defaults);
  CHECK(f("(nil)") == defaults);
  CHECK(f("{}") == defaults);
  CHECK(f("{speed = 2, edges = 6.0, stop_at_contact = true, norm = 'Linf', point = {1, 2, 3}, pose "
          "= {xyz = {4, 5, 6}}, "
          "dofs = {1, 2, 3}, rows = {{1, 2}}, name = 'x', seed = 9, hook = print}") ==
        "2 6 true Linf 3 4 3 1 x 9 true");
  CHECK(f("{point = clench.vec3(1, 2, 3), pose = clench.pose{xyz = {4, 5, 6}}}") ==
        "1 8 false L1 3 4 0 0 hand 0 false");
}

TEST_CASE("a misspelt key is named, with a suggestion") {
  Options f;
  CHECK(f("{sped = 1}") == "hand:autograsp: unknown key 'sped'; did you mean 'speed'?");
  CHECK(f("{1}") == "hand:autograsp: unknown key [1]");
  CHECK(f("{zzz = 1, yyyy = 2}") == "hand:autograsp: unknown key 'yyyy'");
}

TEST_CASE("errors are reported with subject, expected and got") {
  Options f;
  CHECK(f("(3)") == "hand:autograsp: expected a table of options, got 3");
  CHECK(f("{speed = 'fast'}") == "hand:autograsp: speed: expected a number, got 'fast'");
  CHECK(f("{speed = '1'}") == "hand:autograsp: speed: expected a number, got '1'");
  CHECK(f("{speed = 0 / 0}").starts_with("hand:autograsp: speed: expected a finite number, got"));
  CHECK(f("{speed = 0 / 0}").ends_with("got nan"));
  CHECK(f("{speed = -(0 / 0)}").ends_with("got nan"));
  CHECK(f("{speed = -1 / 0}") == "hand:autograsp: speed: expected a finite number, got -inf");
  CHECK(f("{edges = 2.5}") == "hand:autograsp: edges: expected an integer, got 2.5");
  CHECK(f("{edges = 1 << 40}") ==
        "hand:autograsp: edges: expected an integer of 32 bits, got 1099511627776");
  CHECK(f("{stop_at_contact = 1}") ==
        "hand:autograsp: stop_at_contact: expected true or false, got 1");
  CHECK(f("{norm = 'L3'}") == "hand:autograsp: unknown norm 'L3', expected one of L1, Linf");
  CHECK(f("{point = {1, 2}}") == "hand:autograsp: point: expected 3 numbers, got 2");
  CHECK(f("{point = {1, 2, {}}}") ==
        "hand:autograsp: point[3]: expected a number, got an empty table");
  CHECK(f("{point = 'up'}") == "hand:autograsp: point: expected a vec3 or {x, y, z}, got 'up'");
  CHECK(f("{pose = 1}") == "hand:autograsp: pose: expected a pose, got 1");
  CHECK(f("{pose = {xyz = {1}}}") == "hand:autograsp: pose: xyz: expected 3 numbers, got 1");
  CHECK(f("{dofs = {1, 2}}") == "hand:autograsp: dofs: expected 3 numbers, got 2");
  CHECK(f("{rows = {{1, 2}, {1}}}") == "hand:autograsp: rows[2]: expected 2 numbers, got 1");
  CHECK(f("{rows = {1}}") == "hand:autograsp: rows[1]: expected a list of 2 numbers, got 1");
  CHECK(f("{name = 5}") == "hand:autograsp: name: expected a string, got 5");
  CHECK(f("{name = 'a\\0b'}").find("without zero bytes") != std::string::npos);
  CHECK(f("{hook = 'x'}") == "hand:autograsp: hook: expected a function, got 'x'");
  CHECK(f("{seed = {}}") == "hand:autograsp: seed: expected an integer, got an empty table");
}

TEST_CASE("options are read raw: code of a metatable does not run") {
  Options f;
  CHECK(f("(setmetatable({}, {__index = function() error 'ran' end}))") ==
        "1 8 false L1 0 0 0 0 hand 0 false");
}

TEST_CASE("a long text is shortened in a message") {
  Options f;
  CHECK(f("{speed = ('x'):rep(1e6)}") ==
        "hand:autograsp: speed: expected a number, got '" + std::string(37, 'x') + "...'");
}

TEST_CASE("only complete keys match") {
  Options f;
  CHECK(f("{['speed\\0x'] = 2}") == "hand:autograsp: unknown key 'speed?x'; did you mean 'speed'?");
}

// --- described options ---

namespace {

int described(lua_State* L) {
  Table t(L, 1);
  const double speed = t.number("speed", 1);
  const int count = t.integer("count", 2);
  double size = 0;
  if (t.push("best") != LUA_TNIL) {
    Table best(L, lua_gettop(L), t.what("best").text());
    size = best.number("size", 3);
    best.done();
  }
  lua_pop(L, 1);
  const bool strict = t.boolean("strict", false);
  if (t.has("speed") && speed == 7) t.number("secret", 0);
  t.done();
  return push(L, fmt::format("{} {} {} {}", speed, count, size, strict));
}

int described_list(lua_State* L) {
  double sum = 0;
  each_item(L, 1, {L, {}, "list"}, "a list", [&](int i, const What& what) {
    Table item(L, i, what.text());
    sum += item.number("mass", 0);
    item.done();
  });
  return push(L, sum);
}

const Entry described_entries[] = {
    {"f", guarded<described>, R"(
For tests.
@param options? table  numbers
@option speed? number [m/s, > 0, <= 10] = 1  the speed
@option count? index = 2  number of an element
@option best? table  the best ones
@option best.size? number [1 to 5] = 3  how many
@like clench.load  strict)"},
    {"g", guarded<described_list>, R"(
For tests.
@param list table[]  bodies
@option mass? number [kg, >= 0] = 0  of each)"},
};
const Library described_library{.name = "test", .doc = "", .functions = described_entries};

struct Described : Script {
  Described() {
    lua_pushglobaltable(L);
    set_functions(L, described_entries, nullptr, &described_library);
    lua_pop(L, 1);
  }
  std::string operator()(const std::string& call) {
    auto text = run("return " + call);
    return text.starts_with("test:1: ") ? text.substr(8) : text;
  }
};

}  // namespace

TEST_CASE("numbers are checked against the ranges of the doc, of nested tables and lists too") {
  Described call;
  CHECK(call("f()") == "1 2 0 false");
  CHECK(call("f{speed = 10, count = 1, best = {size = 5}, strict = true}") == "10 1 5 true");
  CHECK(call("f{speed = 0}") == "test.f: speed must be > 0 and <= 10, got 0");
  CHECK(call("f{speed = 10.5}") == "test.f: speed must be > 0 and <= 10, got 10.5");
  CHECK(call("f{speed = 0 / 0}").starts_with("test.f: speed: expected a finite number"));
  CHECK(call("f{count = 0}") == "test.f: count must be >= 1, got 0");
  CHECK(call("f{best = {size = 6}}") == "test.f: best: size must be 1 to 5, got 6");
  CHECK(call("f{best = {sizes = 6}}") ==
        "test.f: best: unknown key 'sizes', expected one of size; did you mean 'size'?");
  CHECK(call("g{{mass = 1}, {mass = 2}}") == "3.0");
  CHECK(call("g{{mass = 1}, {mass = -1}}") == "test.g: list[2]: mass must be >= 0, got -1");
}

TEST_CASE("an option that the doc does not describe is a fault of ours") {
  Described call;
  CHECK(call("f{speed = 7}") == "test.f: option 'secret' is not described");
}
