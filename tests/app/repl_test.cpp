#include "command.h"

using clench::test::Folder;
using clench::test::run;
using clench::test::Terminal;
namespace fs = std::filesystem;

TEST_CASE("piped lines run chunk by chunk, and an error does not end the session") {
  const auto result = run("repl",
                          "x = 3\n=x\nx + 1\nfunction f()\n  return clench.vec3(1, 2, 3), {a = "
                          "1}\nend\nf()\nerror 'no'\n"
                          "nil\nprint()\nx = = 1\n\"last\"");
  CHECK(result.code == 0);
  CHECK(result.out.find("3\n4\n(1, 2, 3)\t{a = 1}\n") == 0);
  CHECK(result.out.find("input:8: no\nstack traceback:") != std::string::npos);
  CHECK(result.out.find("unexpected symbol near '='") != std::string::npos);
  CHECK(result.out.find("nil\n\n") != std::string::npos);
  CHECK(result.out.ends_with("last\n"));
}

TEST_CASE("an error in piped input is reported with its line of the input") {
  const auto out =
      run("repl", "\nx = = 1\nfor i = 1, 2 do\n\nerror 'here'\nend\n=error 'there'\n").out;
  CHECK(out.find("input:2: unexpected symbol near '='") != std::string::npos);
  CHECK(out.find("input:5: here") != std::string::npos);
  CHECK(out.find("input:7: there") != std::string::npos);
}

TEST_CASE("input that ends inside a chunk is reported") {
  const auto result = run("repl", "for i = 1, 2 do\n");
  CHECK(result.code == 1);
  CHECK(result.out == "clench repl: the input ended inside a chunk\n");
}

TEST_CASE("-i runs a file, then the console, also if the file failed") {
  const Folder folder;
  CHECK(run("-i " + folder.file("a.lua", "y = 5"), "=y\n").out == "5\n");
  const auto failed = run("-i " + folder.file("b.lua", "y = 6 error('no', 0)"), "=y\n");
  CHECK(failed.out.find("clench: no\n") == 0);
  CHECK(failed.out.ends_with("6\n"));
}

TEST_CASE("help explains functions, values and names") {
  const auto out =
      run("repl",
          "help(clench.rad)\nhelp(clench.pose{})\nhelp "
          "'inverse'\nhelp(clench.json)\nhelp()\nhelp(5)\nhelp(clench.pose{}.inverse)\n"
          "help(clench.shapes.box)\nhelp 'robustness'\nhelp(string.rep)\nhelp(clench.stats)\nhelp "
          "'gif'\nhelp 'nonsense'\n")
          .out;
  for (const char* part :
       {"clench.rad(degrees)\n  Degrees to radians.", "pose: An immutable rigid transform",
        ".position", "pose:inverse()", "clench.json.encode", "help(x) explains a value",
        "there is no help for 5", "clench.shapes.box(options)\n",
        "clench.study.robustness(grasp, options)", "string.rep is a function of Lua",
        "clench.stats.quantile ",
        "'gif' is not a name; it is mentioned by\n  clench.files.save_gif\n",
        "there is no help for nonsense"})
    CHECK_MESSAGE(out.find(part) != std::string::npos, part);
}

TEST_CASE("the README's console session can be typed") {
  std::ifstream file("README.md");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const size_t begin = text.find("```lua\n") + 7, end = text.find("```", begin);
  REQUIRE(end != std::string::npos);
  const auto result = run("repl", text.substr(begin, end - begin) + "#world.robots\n");
  CHECK_MESSAGE(result.out.find("true\t0.") != std::string::npos, result.out);
  CHECK_MESSAGE(result.out.ends_with("\n1\n"), result.out);
}

TEST_CASE("top-level locals persist, shared with the functions that use them") {
  const auto out = run("repl",
                       "local n = 0 local function inc() n = n + 1 return n end\n"
                       "inc() inc()\nn\nn = 10 print(inc())\n"
                       "local a, b <const> = 3, 4\na * b\n"
                       "do local hidden = 5 end for i = 1, 2 do local hidden = i end\nhidden\n"
                       "local s = [[two\nlines]] local t = 'it\\'s' -- local no = 1\n#s .. t, no\n"
                       "local n = 7\nn, inc()\n"
                       "local c <close> = nil\nc\nlocal _ENV = {}\nprint 'alive'\n"
                       "local lost = 1 error 'x'\nlost\n")
                       .out;
  CHECK_MESSAGE(out.starts_with("2\n11\n12\nnil\n9it's\tnil\n7\t12\nnil\nalive\n"), out);
  CHECK_MESSAGE(out.find("input:18: x") != std::string::npos, out);
  CHECK(out.ends_with("nil\n"));
}

TEST_CASE("locals beyond the limit of a Lua function are dropped, the oldest first") {
  std::string input;
  for (int i = 0; i < 400; ++i) input += fmt::format("local v{} = {}\n", i, i);
  CHECK(run("repl", input + "v399 + v300, v0\n").out == "699\tnil\n");
}

TEST_CASE(
    "exit and quit end the session, _ is the last value, and an unfinished string is an error") {
  CHECK(run("repl", "6 * 7\n_ + 1\nnil\n_\nexit\nprint 'not here'\n").out == "42\n43\nnil\n43\n");
  CHECK(run("repl", "quit()\n7\n").out.empty());
  const auto out = run("repl", "x = \"abc\n5\n").out;
  CHECK(out.starts_with("input:1: unfinished string near '\"abc'\n"));
  CHECK(out.ends_with("5\n"));
}

TEST_CASE("a script's own help and show take precedence") {
  const Folder folder;
  const auto file = folder.file("a.lua", "function show() return 'mine' end help = 5");
  CHECK(run("-i " + file, "show(), help\n").out == "mine\t5\n");
}

TEST_CASE("show prints a complete table") {
  const auto out = run("repl", "t = {} for i = 1, 300 do t[i] = i end\nt\nshow(t)\n").out;
  CHECK(out.find("more}") != std::string::npos);
  CHECK(out.ends_with("299, 300}\n"));
}

TEST_CASE("on a terminal: results, errors, unfinished lines, Ctrl-D") {
  const Folder home;
  Terminal terminal(home);
  terminal.wait_for("> ");
  terminal.enter("6 * 7");
  terminal.wait_for("42");
  terminal.enter("error 'no'");
  terminal.wait_for("stack traceback");
  terminal.wait_for("> ");
  terminal.enter("for i = 1, 2 do");
  terminal.wait_for(">> ");
  terminal.enter("print('turn ' .. i) end");
  terminal.wait_for("turn 2");
  terminal.wait_for("> ");
  terminal.type("\x04");
  CHECK(terminal.wait_for_end() == 0);
}

TEST_CASE("coroutines of the loop run while the prompt waits, and the typed line is kept") {
  const Folder home;
  Terminal terminal(home);
  terminal.wait_for("> ");
  terminal.enter("t = clench.loop.every(0.2, function() print('ti' .. 'ck') end)");
  terminal.wait_for("> ");
  terminal.type("6 * ");
  terminal.wait_for("tick");
  terminal.wait_for("tick");
  terminal.wait_for("6 * ");
  terminal.enter("7");
  terminal.wait_for("42");
  terminal.enter("t:remove() clench.loop.spawn(function() error 'in a loop' end)");
  terminal.wait_for("in a loop");
  terminal.wait_for("> ");
  terminal.enter(
      "job = clench.job(function() return 11 end) "
      "clench.loop.spawn(function() clench.loop.wait(job) print(job:result() * 11) end)");
  terminal.wait_for("121");
  terminal.wait_for("> ");
  // Ctrl-C ends the code that runs in the loop, and the session continues
  terminal.enter("clench.loop.spawn(function() print('bu' .. 'sy') while true do end end)");
  terminal.wait_for("busy");
  terminal.type("\x03");
  terminal.wait_for("interrupted");
  terminal.wait_for("> ");
  terminal.enter("40 + 37");
  terminal.wait_for("77");
  terminal.wait_for("> ");
  terminal.type("\x04");
  CHECK(terminal.wait_for_end() == 0);
}

TEST_CASE("Tab completes globals, fields and methods, and lists ambiguous names") {
  const Folder home;
  Terminal terminal(home);
  terminal.wait_for("> ");
  terminal.enter("clench.ver\t");
  terminal.wait_for("0.");
  terminal.wait_for("> ");
  terminal.enter("v = clench.vec3(3, 4, 0)");
  terminal.wait_for("> ");
  terminal.enter("v:n\t()");
  terminal.wait_for("5.0");
  terminal.wait_for("> ");
  terminal.type("v:\t");
  terminal.wait_for("cross");
  terminal.wait_for("unit");
  terminal.enter("dot{1, 1, 1}");
  terminal.wait_for("7.0");
}

TEST_CASE("Tab completes files, bodies, measures and options") {
  const Folder home;
  home.file("some/where/long_name.lua", "");
  Terminal terminal(home);
  terminal.wait_for("> ");
  terminal.enter(
      "w = clench.world() b = w:add_object(clench.shapes.box {1, 1, 1}, {na\t = 'my_box'})");
  terminal.wait_for("> ");
  terminal.enter("w:body 'my\t'.mass");
  terminal.wait_for("0.3");
  terminal.wait_for("> ");
  terminal.enter("#'" + (home / "so") + "\twh\tlo\t'");
  terminal.wait_for(fmt::format("{}\r\n", (home / "some/where/long_name.lua").size()));
  terminal.wait_for("> ");
  // files of the catalog, from any folder
  terminal.enter("#'worlds/dlr_\t'");
  terminal.wait_for(fmt::format("{}\r\n", std::string("worlds/dlr_flask.wld").size()));
}

TEST_CASE("a pasted tab is inserted as a tab") {
  const Folder home;
  Terminal terminal(home);
  terminal.wait_for("\x1b[?2004h");
  terminal.wait_for("> ");
  terminal.type("\x1b[200~x = #'a\tb'\x1b[201~");
  terminal.enter(" + 10");
  terminal.wait_for("> ");
  terminal.enter("'x is ' .. x");
  terminal.wait_for("x is 13");
}

TEST_CASE("Ctrl-C interrupts a running chunk, and clears a half-typed line") {
  const Folder home;
  Terminal terminal(home);
  terminal.wait_for("> ");
  terminal.enter("print 'running' while true do end");
  terminal.wait_for("running\r\n");
  terminal.type("\x03");
  terminal.wait_for("interrupted");
  terminal.wait_for("> ");
  terminal.type("this is no Lua");
  terminal.wait_for("Lua");
  terminal.type("\x03");
  terminal.wait_for("^C");
  terminal.wait_for("> ");
  terminal.enter("f = function()");
  terminal.wait_for(">> ");
  terminal.type("\x03");
  terminal.wait_for("> ");
  terminal.enter("'still ' .. 'here'");
  terminal.wait_for("still here");
}

TEST_CASE("history persists across sessions, and a chunk of several lines is one entry") {
  const Folder home;
  {
    Terminal terminal(home);
    terminal.wait_for("> ");
    terminal.enter("x = 11");
    terminal.wait_for("> ");
    terminal.enter("x = x * 2");
    terminal.wait_for("> ");
    terminal.type("\x04");
    terminal.wait_for_end();
  }
  CHECK(fs::exists(home / ".clench_history"));
  Terminal terminal(home);
  terminal.wait_for("> ");
  terminal.enter("x = 1");
  terminal.wait_for("> ");
  // two entries up: past x = 1
  terminal.enter("\x1b[A\x1b[A");
  terminal.wait_for("> ");
  terminal.enter("'x is ' .. x");
  terminal.wait_for("x is 2");
}

TEST_CASE("without arguments, the command opens the console on a terminal") {
  const Folder home;
  Terminal terminal(home, "-q");
  terminal.wait_for("exit leaves");
  terminal.wait_for("> ");
  terminal.enter("print(clench ~= nil)");
  terminal.wait_for("true");
}

TEST_CASE("a signal ends the console with the signal's exit status, and the terminal is restored") {
  for (const int signal : {SIGTERM, SIGHUP, SIGQUIT}) {
    CAPTURE(signal);
    const Folder home;
    {  // at the prompt, in the middle of a line
      Terminal terminal(home);
      terminal.wait_for("> ");
      terminal.enter("x = 1");
      terminal.wait_for("> ");
      terminal.type("half a li");
      terminal.wait_for("li");
      CHECK(terminal.is_raw());
      const auto end = terminal.end_by(signal);
      CHECK(end.code == 1000 + signal);
      CHECK(end.cooked);
    }
    CHECK(fs::exists(home / ".clench_history"));
    {  // while a chunk runs
      Terminal terminal(home);
      terminal.wait_for("> ");
      terminal.enter("print 'running' while true do end");
      terminal.wait_for("running\r\n");
      const auto end = terminal.end_by(signal);
      CHECK(end.code == 1000 + signal);
      CHECK(end.cooked);
    }
  }
}

TEST_CASE(
    "messages of other threads replace the progress bar, and bars of other threads stay hidden") {
  const Folder home;
  Terminal terminal(home);
  terminal.wait_for("> ");
  terminal.enter(
      "function wait(s) local c = require 'clench' local t = c.clock() while c.clock() < t + s do "
      "end end");
  terminal.enter(
      "function work() local c = require 'clench' local p, t = c.progress(2, 'in' .. 'ner'), "
      "c.clock() while c.clock() < t + 0.6 do end p:step() c.log.warning 'thin' end");
  terminal.enter(
      "p = clench.progress(2, 'all') wait(0.6) p:step() clench.parallel.map(work, {1}) p:close() "
      "print('o' .. 'ver')");
  terminal.wait_for("[##");
  const std::string seen = terminal.wait_for("over");
  CHECK(seen.find("\r\x1b[Kclench: warning: thin\r\n") != std::string::npos);
  CHECK(seen.find("inner") == std::string::npos);
}

TEST_CASE("a stopped console restores the terminal, and takes it again when it continues") {
  const Folder home;
  Terminal terminal(home);
  terminal.wait_for("> ");
  kill(terminal.process(), SIGTSTP);
  int status = 0;
  // an orphaned process group is not stopped: then only the continuation is checked
  waitpid(terminal.process(), &status, WUNTRACED | WNOHANG);
  kill(terminal.process(), SIGCONT);
  terminal.enter("'still ' .. 'here'");
  terminal.wait_for("still here");
  terminal.wait_for("> ");
  CHECK(terminal.is_raw());
  terminal.type("\x04");
  CHECK(terminal.wait_for_end() == 0);
}
