// Effects of checked files on a check, and files that are read when reading is confined.
#include "command.h"

using clench::test::Folder;
using clench::test::has;
using clench::test::run;
namespace fs = std::filesystem;

// worlds in Lua that end the program, by all functions that can
static constexpr const char* endings[] = {
    "os.exit(0)",
    "os.exit(true, true)",
    "pcall(os.exit, 0) return clench.world()",
    "pcall(function() os.exit(0) end) return clench.world()",
    "coroutine.wrap(function() os.exit(0) end)()",
    "coroutine.resume(coroutine.create(os.exit), 0) return clench.world()",
    "xpcall(error, function() os.exit(0) end) return clench.world()",
    "setmetatable({}, {__gc = function() os.exit(0) end}) collectgarbage() return clench.world()",
    "kept = setmetatable({}, {__gc = function() os.exit(0) end}) return clench.world()",
    "local x <close> = setmetatable({}, {__close = function() os.exit(0) end}) return "
    "clench.world()",
    "error(setmetatable({}, {__tostring = function() os.exit(0) end}))",
    "return os.exit",
};

TEST_CASE("a checked or converted file cannot end the program by any function") {
  const Folder folder;
  for (const char* code : endings) {
    CAPTURE(std::string(code));
    const std::string file = folder.file("world.lua", code);
    for (const std::string& arguments :
         {"check " + file, "check --json " + file, "convert " + file + " " + (folder / "w.wld")}) {
      const auto result = run(arguments + " models/objects/no_such.iv");
      CHECK(result.code != 0);
    }
    const auto check = run("check " + file + " models/objects/flask.iv");
    CHECK(check.code == 1);
    CHECK(has(check.out, "flask.iv: a body"));  // the others are checked
    const std::string text = code;
    CHECK(
        has(check.out, text == "return os.exit" ? "expected a script that returns a world"
                       : text.find("__tostring") != std::string::npos
                           ? "expected an error with a message, got a table whose __tostring fails"
                           : "os.exit: a file that is read cannot end the program"));
    CHECK(check.out.find("traceback") == std::string::npos);
    CHECK(run("convert " + file + " " + (folder / "w.wld")).code == 1);
  }
  CHECK(has(run("check " + folder.file("w.lua", "\n\npcall(os.exit) return clench.world()")).out,
            "w.lua:3: os.exit: a file"));
}

// errors whose values give no message, or a very long one
static constexpr const char* errors[] = {
    "error(setmetatable({}, {__tostring = function() error 'worse' end}))",
    "error(setmetatable({}, {__tostring = function() error() end}))",
    "error(setmetatable({}, {__tostring = function() return 5 end}))",
    "error(setmetatable({}, {__index = error, __len = error, __name = 7}))",
    "error()",
    "error(nil)",
    "error(io.stdout)",
    "error(print)",
    "error {code = 3}",
    "error(('x'):rep(5e6))",
    "error(coroutine.create(print))",
    "coroutine.wrap(function() error(setmetatable({}, {__tostring = error})) end)()",
    "local t = {} t[1] = t error(t)",
};

TEST_CASE("an error whose value cannot be printed is reported in one sentence") {
  const Folder folder;
  for (const char* code : errors) {
    CAPTURE(std::string(code));
    const std::string file = folder.file("world.lua", code);
    const auto check = run("check " + file + " models/objects/flask.iv");
    CHECK(check.code == 1);
    CHECK(has(check.out, "world.lua: not a world that can be read\n  error: "));
    CHECK(check.out.find("traceback") == std::string::npos);
    CHECK(check.out.size() < 10000);
    for (const std::string verb : {"run ", "test ", "-i ", "convert "}) {
      const auto result =
          run(verb + file + (verb == "convert " ? " " + (folder / "w.wld") : ""), "");
      CHECK(result.code == (verb == "-i " ? 0 : 1));
      CHECK(result.out.size() < 10000);
      CHECK(!result.out.empty());
      CHECK((verb == "convert ") == (result.out.find("traceback") == std::string::npos));
    }
  }
  CHECK(has(run("-e '" + std::string(errors[0]) + "'").out, "clench: "));
  CHECK(has(run("-e 'error(setmetatable({}, {__tostring = error}))'").out,
            "clench: error object is a table whose __tostring fails\nstack traceback:"));
  CHECK(has(run("-e 'error((\"x\"):rep(1e5), 0)'").out, "xx... (100000 characters)\nstack"));
}

TEST_CASE("--confine restricts reading of models to a folder, for every verb") {
  const Folder folder;
  fs::create_directories(folder / "in");
  fs::copy_file("models/objects/flask.iv", folder / "flask.iv");
  fs::copy_file("models/objects/flask.iv", folder / "in/flask.iv");
  folder.file("in/w.wld",
              "#GraspIt! version 2.0\nGraspableBody\n../flask.iv\nT (1 0 0 0)[0 0 0]\n");
  folder.file("in/good.wld",
              "#GraspIt! version 2.0\nGraspableBody\nflask.iv\nT (1 0 0 0)[0 0 0]\n");
  folder.file("in/w.lua", "error 'run'");
  const std::string in = folder / "in", confined = " --confine " + in + " ";
  CHECK(run("check " + in + "/w.wld").code == 0);
  const auto check = run("check" + confined + in + "/w.wld");
  CHECK(check.code == 1);
  CHECK(has(check.out, "error: w.wld:3: '../flask.iv' lies outside of "));
  CHECK(run("check" + confined + in + "/good.wld " + in + "/flask.iv").code == 0);
  CHECK(has(run("check" + confined + (folder / "flask.iv")).out, "lies outside of"));
  CHECK(run("convert" + confined + in + "/flask.iv " + (folder / "out.obj")).code == 0);
  CHECK(run("convert" + confined + in + "/good.wld " + (folder / "out.lua")).code == 0);
  CHECK(run("convert" + confined + in + "/w.wld " + (folder / "out2.lua")).code == 1);

  // a world in Lua is a program, and is not run
  const auto world = run("check" + confined + in + "/w.lua");
  CHECK(world.code == 1);
  CHECK(has(world.out, "w.lua: a world in Lua is a program, which may read any file"));

  // scripts inherit the folder as their default, which a call may change
  const std::string script = folder.file(
      "s.lua",
      "local in_, out = ...\nlocal w = clench.world()\nw:add_object(in_ .. '/flask.iv')\n"
      "for _, f in ipairs {function(...) w:add_object(...) end, function(...) w:add_obstacle(...) "
      "end,\n"
      "  function(...) w:add_robot(...) end, clench.load, clench.file_kind, "
      "clench.files.eigengrasps,\n"
      "  clench.files.primitives, clench.files.pregrasps,\n"
      "  function(...) local r = clench.report.of(...) assert(not r.error, r.error) end,\n"
      "  function(f, o) clench.convert(f, in_ .. '/x.obj', o) end} do\n"
      "  local ok, message = pcall(f, out)\n  assert(not ok and message:find 'lies outside of', "
      "message)\n"
      "  ok, message = pcall(f, in_ .. '/flask.iv', {confine = 'models'})\n"
      "  assert(not ok and message:find 'lies outside of', message)\nend\n"
      "w:add_object(out, {confine = '/'})\nassert(#clench.catalog().hands == 0)\n"
      "print(pcall(w.add_object, w, out, {confine = out}))");
  const std::string arguments = script + " " + in + " " + (folder / "flask.iv");
  const auto result = run("run" + confined + arguments);
  CHECK_MESSAGE(result.code == 0, result.out);
  CHECK(has(result.out, "world:add_object: confine: expected a folder, got '"));
  CHECK(run(confined + "run " + arguments).code == 0);
  const std::string load = "clench.world():add_object '" + (folder / "flask.iv") + "'";
  CHECK(has(run(confined + "-e \"" + load + "\"").out, "lies outside of"));
  CHECK(has(run("repl" + confined, load).out, "lies outside of"));
  CHECK(has(run("test" + confined + folder.file("a_test.lua", load)).out, "lies outside of"));
  CHECK(run("check --confine " + (folder / "none") + " " + in + "/flask.iv").code == 2);
}

TEST_CASE("every verb that loads files names in its help the files that are run as programs") {
  for (const std::string verb : {"run", "test", "repl", "check", "convert"}) {
    const auto help = run(verb + " --help");
    CHECK(has(help.out, "Scripts and worlds in Lua are programs; files of every other format run"));
    CHECK(has(help.out, "--confine"));
  }
}
