#include "command.h"

using clench::test::Folder;
using clench::test::has;
using clench::test::run;

TEST_CASE("run passes arguments to a script unchanged") {
  const Folder folder;
  const auto script =
      folder.file("a.lua", "print(arg[0] == ..., #arg, select(2, ...))  print(arg[0])");
  const auto result = run("run " + script + " " + script + " --help -q -- -e x");
  CHECK(result.code == 0);
  CHECK(has(result.out, "true\t6\t--help\t-q\t--\t-e\tx\n" + script));
}

TEST_CASE(
    "run exits with 0 if the script ends, with 1 and a traceback if it fails, and with the code of "
    "os.exit") {
  const Folder folder;
  CHECK(run("run " + folder.file("ok.lua", "local x = 1")).code == 0);
  const auto failed =
      run("run " + folder.file("bad.lua", "local function f()\n  error 'no'\nend\nf()"));
  CHECK(failed.code == 1);
  CHECK(has(failed.out, "bad.lua:2: no\nstack traceback:"));
  CHECK(has(failed.out, "bad.lua:4: in main chunk"));
  CHECK(run("run " + folder.file("exit.lua", "os.exit(7)")).code == 7);
  CHECK(run("run " + folder.file("close.lua", "os.exit(true, true)")).code == 0);
  CHECK(run("run " + folder.file("syntax.lua", "x = = 1")).code == 1);
  const auto missing = run("run no_such.lua");
  CHECK(missing.code == 1);
  CHECK(has(missing.out, "cannot open no_such.lua"));
}

TEST_CASE("run reads a script from standard input") {
  const auto result = run("run - a b", "print('in', ...)");
  CHECK(result.code == 0);
  CHECK(result.out == "in\ta\tb\n");
  // like a pipe into `lua`
  CHECK(run("", "print('in', ...)").out == "in\n");
}

TEST_CASE("output printed before an error precedes the error message") {
  const auto result = run("-e 'print(1) error(\"x\", 0)'");
  CHECK(has(result.out, "1\nclench: x\n"));
}

TEST_CASE("-e runs code in order and stops at the first error") {
  const auto result = run("-e 'x = 1' -e 'print(x, clench.version)'");
  CHECK(result.code == 0);
  CHECK(has(result.out, "1\t0."));
  const auto failed = run("-e 'error{code = 3}' -e 'print(\"not reached\")'");
  CHECK(failed.code == 1);
  CHECK(has(failed.out, "error object is the table {code = 3}"));
  CHECK(failed.out.find("not reached") == std::string::npos);
}

TEST_CASE("wrong usage exits with 2, and help exits with 0 and shows examples") {
  CHECK(run("frob").code == 2);
  CHECK(has(run("rnu a.lua").out, "there is no verb 'rnu'; did you mean 'run'?"));
  CHECK(has(run("examples/01_first_grasp.lua").out,
            "to run a script: clench run examples/01_first_grasp.lua"));
  CHECK(run("run").code == 2);
  CHECK(run("test").code == 2);
  CHECK(run("test").out ==
        "clench test: DIR is required\nRun clench test --help for more information.\n");
  CHECK(run("--frob").code == 2);
  CHECK(run("-e").code == 2);
  CHECK(has(run("-e").out, "clench: -e: expected a value, got none\n"));
  CHECK(has(run("test --hepl").out,
            "clench test: there is no option '--hepl'; did you mean '--help'?"));
  for (const std::string words : {"run ''", "-i ''", "test ''", "doc ''", "plan '' b.iv",
                                  "plan a.cfg b.iv -o ''", "plan a.cfg b.iv --obstacle ''"}) {
    CHECK(run(words).code == 2);
    CHECK(has(run(words).out, ": expected the name of a file, got nothing\n"));
  }
  CHECK(run("doc --chekc").code == 2);
  for (const std::string verb : {"", "run ", "repl ", "test ", "doc "}) {
    const auto help = run(verb + "--help");
    CHECK(help.code == 0);
    CHECK(has(help.out, "clench " + verb));
    CHECK(has(help.out, "Example"));
  }
  CHECK(has(run("--version").out, "clench 0."));
  CHECK(has(run("version").out, "clench 0."));
  CHECK(has(run("help").out, "Usage: clench"));
  CHECK(has(run("plan --coun 3 a.cfg b.iv").out,
            "clench plan: there is no option '--coun'; did you mean '--count'?"));
  CHECK(run("plan --coun 3 a.cfg b.iv").code == 2);
  CHECK(has(run("plan a.cfg b.iv c.iv").out, "clench plan: one argument too many: 'c.iv'"));
  // no arguments and no terminal
  CHECK(has(run("").out, "Usage: clench"));
}

TEST_CASE("quiet suppresses warnings and errors of finalizers") {
  const std::string code =
      "-e 'clench.log.warning(\"careful\") setmetatable({}, {__gc = function() error(\"gc\") end}) "
      "collectgarbage()'";
  const auto loud = run(code);
  CHECK(has(loud.out, "clench: warning: careful\n"));
  CHECK(has(loud.out, "gc"));
  CHECK(run("-q " + code).out == "");
}

TEST_CASE("test runs every file separately, in sorted order, and counts the results") {
  const Folder folder;
  folder.file(
      "b_test.lua",
      "local test = require 'test' assert(leak == nil) test('b', function(t) t.equal(1, 1) end)");
  folder.file("sub/a_test.lua",
              "test = require 'test' leak = 1 test('a', function(t) t.close(1, 1.1, 0.2) end)\n"
              "test('later', function(t) t.skip 'no data' end)");
  folder.file("not_a_test.txt", "rubbish");
  auto result = run("test " + (folder / "."));
  CHECK(result.code == 0);
  CHECK(has(result.out, "skipped  later: no data"));
  CHECK(has(result.out, "\n2 passed, 0 failed, 1 skipped\n"));
  CHECK(result.out.find("b_test.lua") < result.out.find("a_test.lua"));

  folder.file("c_test.lua",
              "local test = require 'test'\ntest('c holds', function(t)\n  t.equal(1, 2)\nend)");
  folder.file("d_test.lua", "x = = 1");
  folder.file("e_test.lua", "error 'outside'");
  result = run("test " + (folder / "."));
  CHECK(result.code == 1);
  CHECK(has(result.out, "FAILED   c holds"));
  CHECK(has(result.out, "c_test.lua:3: expected 2, got 1"));
  CHECK(has(result.out, "d_test.lua: the file itself"));
  CHECK(has(result.out, "outside"));
  CHECK(result.out.ends_with("2 passed, 3 failed, 1 skipped\n"));

  result = run("test " + (folder / "b_test.lua"));
  CHECK(result.code == 0);
  CHECK(result.out.ends_with("1 passed, 0 failed, 0 skipped\n"));
  const auto none = run("test " + (folder / "nowhere"));
  CHECK(none.code == 1);
  CHECK(has(none.out, "clench test: no such file or folder: "));
  folder.file("empty/readme.txt", "");
  const auto empty = run("test " + (folder / "empty"));
  CHECK(empty.code == 1);
  CHECK(has(empty.out, "no *_test.lua in"));
}

TEST_CASE("temporary files of tests in Lua are removed after the run, also after a failure") {
  const Folder folder;
  const std::string file = folder.file("a_test.lua",
                                       "local test = require 'test'\n"
                                       "print('<' .. test.path('', 'text') .. '>')\n"
                                       "print('<' .. test.folder() .. '>')\n"
                                       "error 'ends'");
  const auto result = run("test " + file);
  CHECK(result.code == 1);
  int paths = 0;
  for (size_t from = 0; (from = result.out.find("</", from)) != std::string::npos; ++paths) {
    const size_t end = result.out.find('>', from);
    const std::filesystem::path path = result.out.substr(from + 1, end - from - 1);
    CHECK(!std::filesystem::exists(path.parent_path()));
    from = end;
  }
  CHECK(paths == 2);
}

TEST_CASE("Ctrl-C ends a run of tests, prints the results so far and exits with 130") {
  const Folder folder;
  folder.file("a_test.lua",
              "local test = require 'test'\n"
              "test('done', function(t) t.ok(true) end)\n"
              "test('endless', function() while true do end end)\n"
              "test('not begun', function() print 'begun' end)");
  folder.file("b_test.lua", "print 'begun'");
  const auto result = run("test " + (folder / "."), "", "timeout --preserve-status -s INT 1");
  CHECK(result.code == 130);
  CHECK(has(result.out, "FAILED   endless\n           interrupted\n"));
  CHECK(result.out.ends_with("1 passed, 1 failed, 0 skipped; interrupted\n"));
  CHECK(result.out.find("begun\n") == std::string::npos);
}

TEST_CASE("a test file that ends the program or contains no test fails") {
  const Folder folder;
  folder.file("a_test.lua",
              "local test = require 'test' test('ends', function() os.exit(0) end)\n"
              "test('goes on', function(t) t.ok(true) end)");
  folder.file("b_test.lua", "require 'test'\nos.exit(0)");
  folder.file("c_test.lua", "local test = require 'test'");
  folder.file("d_test.lua", "local test = require 'test' test('d', function(t) t.ok(true) end)");
  const auto result = run("test " + (folder / "."));
  CHECK(result.code == 1);
  CHECK(has(result.out, "FAILED   ends"));
  CHECK(has(result.out, "a_test.lua:1: os.exit: a file of tests cannot end the run"));
  CHECK(has(result.out, "b_test.lua: the file itself"));
  CHECK(has(result.out, "b_test.lua:2: os.exit: "));
  CHECK(has(result.out, "c_test.lua: the file itself\n           expected a test in it, got none"));
  CHECK(has(result.out, "2 passed, 3 failed"));
}

TEST_CASE("describe prints an entry with ranges and defaults, as text and as JSON") {
  const auto text = run("describe hand:autograsp");
  CHECK(text.code == 0);
  CHECK(has(text.out, "speed?: number = 1  of all closing speeds"));
  const auto json = run("describe --json clench.plan.sample");
  CHECK(json.code == 0);
  CHECK(has(json.out, R"("default":100,"max":1000000,"min":1,"name":"count")"));
  CHECK(has(run("describe").out, "clench.rad "));
  const auto unknown = run("describe clench.rda");
  CHECK(unknown.code == 1);
  CHECK(has(unknown.out, "there is no entry 'clench.rda'; did you mean 'clench.rad'?"));
}

TEST_CASE("doc writes pages, and --check finds an outdated page") {
  const Folder folder;
  const std::string pages = folder / "api";
  CHECK(run("doc " + pages + " --check").code == 1);
  CHECK(run("doc " + pages).code == 0);
  CHECK(run("doc " + pages + " --check").code == 0);
  folder.file("api/pose.md", "# something else");
  const auto check = run("doc " + pages + " --check");
  CHECK(check.code == 1);
  CHECK(has(check.out, "pose.md is out of date; run clench doc"));
  // the stub is valid Lua
  CHECK(run("run " + pages + "/clench.lua").code == 0);
  const std::string file = folder.file("file", "x");
  CHECK(has(run("doc " + file).out, "the file cannot be written: Not a directory"));
  CHECK(has(run("doc", "", "cd " + (folder / ".") + " &&").out,
            "clench doc: expected a folder to write to, as there is no docs/api here"));
}

TEST_CASE("output that cannot be written is an error") {
  for (const char* arguments :
       {"check --json models/objects/flask.iv", "--help", "-e 'print(1)'"}) {
    const auto outcome = run(std::string(arguments) + " 4>&1 > /dev/full 2>&4; exit $?");
    CHECK(outcome.code == 1);
    CHECK(has(outcome.out, "clench: the output could not be written completely"));
  }
}

TEST_CASE("check reports the kind of each file, and exits with 1 if a file cannot be read") {
  const auto flask = run("check models/objects/flask.iv models/hands/barrett/barrett.cfg");
  CHECK(flask.code == 0);
  CHECK(has(flask.out, "models/objects/flask.iv: a body"));
  CHECK(has(flask.out, "models/hands/barrett/barrett.cfg: a robot"));
  const auto bad = run("check tests/data/bad/wld/empty.wld models/objects/flask.iv");
  CHECK(bad.code == 1);
  CHECK(has(bad.out, "error: "));
  CHECK(has(bad.out, "flask.iv: a body"));
  const auto json = run("check --json models/objects/flask.iv");
  CHECK(json.code == 0);
  CHECK(json.out.front() == '[');
  // names that are not UTF-8 are escaped, and the reports of the other files are unchanged
  const Folder folder;
  folder.file("n\xE9\xFF.wld", "x");
  const auto odd = run("check --json " + (folder / "n\xE9\xFF.wld") + " models/objects/flask.iv");
  CHECK(odd.code == 1);
  CHECK(has(odd.out, "n\\\\xE9\\\\xFF.wld"));
  CHECK(has(odd.out, "\"kind\":\"body\""));
  const auto none = run("check --root /no/such/folder models/objects/flask.iv");
  CHECK(none.code == 2);
  CHECK(has(none.out, "--root: Directory does not exist: /no/such/folder"));
  CHECK(run("check no_such.iv").code == 1);
  CHECK(has(run("check tests/data/urdf/gripper.urdf").out, "package"));
  CHECK(run("check --package tests/data/urdf tests/data/urdf/gripper.urdf").code == 0);
  CHECK(run("check").code == 2);
}

TEST_CASE("strict reading rejects repaired, unused and suspicious data") {
  const Folder folder;
  const std::string body = folder.file("b.xml", "<root>\n<mass>-300</mass></root>"),
                    world =
                        folder.file("w.lua", "local world = clench.world()\nworld:add_object('" +
                                                 body + "')\nreturn world"),
                    out = folder / "out.xml";
  CHECK(run("check " + body).code == 0);
  for (const std::string& file : {body, world}) {
    const auto checked = run("check --strict " + file);
    CHECK(checked.code == 1);
    CHECK(has(checked.out, "error: b.xml:2: mass: -300 is negative; 300 is used"));
  }
  CHECK(run("check --strict models/objects/flask.iv").code == 0);
  const auto converted = run("convert --strict " + body + " " + out);
  CHECK(converted.code == 1);
  CHECK(has(converted.out, "clench convert: b.xml:2: mass: -300 is negative; 300 is used"));
  CHECK(run("check " + out).code == 1);
  CHECK(run("convert " + body + " " + out).code == 0);
}

TEST_CASE("convert writes another format, reports losses, and exits with 1 on failure") {
  const Folder folder;
  const std::string out = (folder / "flask.stl");
  const auto flask = run("convert models/objects/flask.iv " + out);
  CHECK(flask.code == 0);
  CHECK(has(flask.out, out + ": body, from models/objects/flask.iv"));
  CHECK(has(flask.out, "flask.stl does not hold material"));
  CHECK(run("check " + out).code == 0);
  const auto world = run("convert worlds/dlr_flask.wld " + (folder / "w.lua"));
  CHECK(world.code == 0);
  CHECK(run("check " + (folder / "w.lua")).code == 0);
  const auto wrong = run("convert models/objects/flask.iv " + (folder / "flask.cfg"));
  CHECK(wrong.code == 1);
  CHECK(wrong.out ==
        "clench convert: flask.cfg: expected a body to .xml, .iv, .obj, .off, .ply or .stl, got "
        "'.cfg'\n");
  const auto same = run("convert models/objects/flask.iv models/objects/flask.iv");
  CHECK(same.code == 1);
  CHECK(has(same.out, "expected another file to write, got the same"));
  CHECK(run("convert models/objects/flask.iv").code == 2);
  CHECK(has(run("convert --unit mile " + out + " " + (folder / "a.obj")).out,
            "unknown unit 'mile', expected one of mm, cm, m, inch, foot"));
  CHECK(run("convert --unit mile " + out + " " + (folder / "a.obj")).code == 2);
  CHECK(run("check --unit mile " + out).code == 2);
}
