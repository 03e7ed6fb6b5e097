// Modules that a command loads: those of Clench and those of the script.
#include "command.h"

using clench::test::Folder;
using clench::test::has;
using clench::test::run;

// files with the names of Clench's modules, each of which prints a line when it runs
static void plant(const Folder& folder) {
  for (const std::string name : {"clench",
                                 "clench/init",
                                 "clench/report",
                                 "clench/show",
                                 "clench/options",
                                 "clench/test",
                                 "clench/shapes",
                                 "clench/shapes/init",
                                 "clench/shapes/box",
                                 "clench/host/check",
                                 "clench/host/convert",
                                 "clench/host/reading",
                                 "clench/host/paths",
                                 "clench/host/coroutines",
                                 "clench/host/doc",
                                 "clench/host/help",
                                 "clench/host/complete",
                                 "report",
                                 "test",
                                 "show",
                                 "shapes",
                                 "study",
                                 "host/check",
                                 "host/paths"})
    folder.file(name + ".lua", "io.stdout:write 'PLANTED\\n' return {}");
  folder.file("clench.so", "PLANTED");  // opening it would be an error
}

TEST_CASE("user files with the names of Clench's modules never run in their place") {
  const Folder folder;
  plant(folder);
  const auto flask = std::filesystem::absolute("models/objects/flask.iv").string();
  const std::string script = folder.file(
      "script.lua",
      "assert(require 'clench.report'.of and require 'report' == clench.report)\n"
      "assert(require 'test'.run_file and require 'clench.shapes.box' == clench.shapes.box)\n"
      "package.loaded.clench = nil  assert(require 'clench' == clench)\n"
      "package.loaded['clench.show'] = nil  assert(require 'clench.show' {} == '{}')\n"
      "print(select(2, pcall(require, 'clench.mine')))");
  folder.file("clench/mine.lua", "io.stdout:write 'PLANTED\\n'");
  folder.file("a_test.lua", "require 'test' ('holds', function(t) t.ok(clench.shapes.box) end)");
  for (const std::string environment :
       {"", "LUA_PATH='./?.lua;./?/init.lua;;' LUA_CPATH='./?.so' LUA_INIT='print [[PLANTED]]'",
        "LUA_PATH_5_4='./?.lua' LUA_CPATH_5_4='./?.so;;'"}) {
    const std::string before = "cd " + (folder / ".") + " && " + environment;
    for (const std::string& arguments :
         {"check " + flask, "check --json " + flask, "convert " + flask + " out.obj",
          std::string("doc api"), std::string("test a_test.lua"), std::string("run script.lua"),
          std::string("-e 'dofile [[script.lua]]'")}) {
      CAPTURE(environment);
      CAPTURE(arguments);
      const auto result = run(arguments, "", before);
      CHECK(result.code == 0);
      CHECK_MESSAGE(result.out.find("PLANTED") == std::string::npos, result.out);
    }
    const auto console =
        run("repl", "help(clench.rad)\n=require 'clench.shapes'.box ~= nil\n", before);
    CHECK(has(console.out, "Degrees to radians"));
    CHECK(has(console.out, "true"));
    CHECK(console.out.find("PLANTED") == std::string::npos);
  }
  CHECK(has(run("run " + script).out, "no module 'clench.mine' in clench's standard library"));
}

TEST_CASE("a script's own modules are found next to it, then by LUA_PATH, and nowhere else") {
  const Folder folder;
  folder.file("mine.lua", "return 'where one stands'");
  folder.file("sub/mine.lua", "return 'beside ' .. select(2, ...)");
  folder.file("sub/parts/init.lua", "return require 'parts.one'");
  folder.file("sub/parts/one.lua", "return 'a part'");
  folder.file("sub/options.lua", "return 'a name that ours uses inside'");
  folder.file("sub/s.lua", "print(require 'mine', require 'parts', (require 'options'))");
  folder.file("sub/a_test.lua",
              "require 'test' ('beside', function(t) t.equal(require 'parts', 'a part') end)");
  folder.file("other/s.lua", "print(pcall(require, 'mine'))");
  folder.file("lib/mine.lua", "return 'of the library'");
  const std::string here = "cd " + (folder / ".") + " && ";
  CHECK(run("run sub/s.lua", "", here).out ==
        "beside sub/mine.lua\ta part\ta name that ours uses inside\n");
  CHECK(has(run("test sub", "", here).out, "1 passed, 0 failed"));
  const auto other = run("run other/s.lua", "", here);
  CHECK(has(other.out, "false\tmodule 'mine' not found"));
  CHECK(has(other.out, "no file 'other/mine.lua'"));
  CHECK(other.out.find("'./") == std::string::npos);
  CHECK(has(run("run other/s.lua", "", here + "LUA_PATH='lib/?.lua;;'").out, "of the library"));
  // code that is typed, piped or given by -e uses the current folder
  CHECK(has(run("-e 'print(require [[mine]])'", "", here).out, "where one stands"));
  CHECK(has(run("run -", "print(require 'mine')", here).out, "where one stands"));
  CHECK(has(run("repl", "=require 'mine'", here).out, "where one stands"));
  CHECK(has(run("-i other/s.lua", "=pcall(require, 'parts')", here).out,
            "no file 'other/parts.lua'"));
}

TEST_CASE("a world in Lua finds the modules next to it while it runs") {
  const Folder folder;
  folder.file("w/parts.lua", "return clench.world()");
  folder.file("w/world.lua", "return require 'parts'");
  folder.file("parts.lua", "error 'not this one'");
  const std::string here = "cd " + (folder / ".") + " && ";
  const auto check = run("check w/world.lua", "", here);
  CHECK(check.code == 0);
  CHECK(has(check.out, "w/world.lua: a world"));
  folder.file("s.lua", "clench.load 'w/world.lua' print(pcall(require, 'gone'))");
  CHECK(has(run("run s.lua", "", here).out, "no file './gone.lua'"));
}
