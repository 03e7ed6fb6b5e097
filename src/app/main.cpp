#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "clench/app/verb_options.h"
#include "clench/app/verbs.h"
#include "clench/base/error.h"
#include "clench/base/printable.h"
#include "clench/base/suggest.h"

namespace clench {

struct CommandLine {
  std::vector<std::string> ours;    ///< up to and including the script's name
  std::vector<std::string> script;  ///< the rest, passed to the script
};

// `clench run FILE --x 1`: everything after FILE is passed to the script unchanged
static CommandLine split(int argc, char** argv) {
  CommandLine line;
  bool run = false, file = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (file) {
      line.script.push_back(word);
      continue;
    }
    line.ours.push_back(word);
    const bool option = word.size() > 1 && word[0] == '-';
    if (run && !option) file = true;
    if (!run && word == "run") run = true;
    // the next word is this option's value, not the verb
    const bool value = word == "--confine" || (!run && (word == "-e" || word == "-i"));
    if (value && i + 1 < argc) line.ours.push_back(argv[++i]);
  }
  return line;
}

// text in --help of every verb that loads files
static const std::string trust =
    "\n\nScripts and worlds in Lua are programs; files of every other format run nothing, and can "
    "only name other regular files to be read, with --confine only files below FOLDER. See "
    "docs/guide/trust.md.";

// the parsed verb, or the program if there is none
static const CLI::App& verb_of(const CLI::App& app) {
  const auto verbs = app.get_subcommands();
  return verbs.empty() ? app : *verbs.front();
}

// Prints an error in the command line, and a reference to --help.
static int refuse(const CLI::App& app, const std::string& why) {
  const CLI::App& verb = verb_of(app);
  const std::string name = &verb == &app ? "clench" : "clench " + verb.get_name();
  std::fprintf(stderr, "%s: %s\nRun %s --help for more information.\n", name.c_str(),
               printable(why, "\n\t").c_str(), name.c_str());
  return 2;
}

// Prints the first word that neither the program nor the parsed verb accepts, and suggests the
// option that may have been meant.
static int refuse_extra(const CLI::App& app) {
  const auto extras = app.remaining(true);
  // an option rather than the word that would have been its value
  const auto option =
      std::ranges::find_if(extras, [](const std::string& word) { return word.starts_with('-'); });
  const std::string word = option != extras.end() ? *option : extras.front();
  std::vector<std::string> known;
  for (const CLI::App* of : {&app, &verb_of(app)})
    for (const CLI::Option* one : of->get_options())
      for (const std::string& name : one->get_lnames()) known.push_back("--" + name);
  if (option == extras.end()) return refuse(app, fmt::format("one argument too many: '{}'", word));
  return refuse(app, fmt::format("there is no option '{}'{}", word,
                                 did_you_mean(word.substr(0, word.find('=')), known)));
}

// parsed options of all verbs
struct Said {
  RunOptions run;
  CheckOptions check;
  ConvertOptions convert;
  PlanOptions plan;
  RenderVerbOptions render;
  ServeOptions serve, mcp;
  ViewOptions view;
  std::string interactive, test_path, doc_folder, confine;
  bool check_docs = false;
  std::string described;
  bool describe_json = false;
};

static void add_script_verbs(CLI::App& app, Said& said) {
  auto* run = app.add_subcommand("run", "run a script");
  run->add_option("FILE", said.run.file,
                  "a Lua script, or - for stdin; all further words are its arguments")
      ->required()
      ->check(named);
  run->footer("Examples:\n  clench run grasp.lua\n  clench run plan.lua mug.iv --seconds 10" +
              trust);
  auto* repl = app.add_subcommand("repl", "open a console");
  repl->add_flag("--view", said.run.view,
                 "open a window beside the console; session and view are defined");
  repl->footer(
      "Examples:\n  clench repl\n  clench repl --view\n  echo '=clench.rad(90)' | clench repl\n\nIn a console: =x or x "
      "prints, help(x) explains, Tab completes, Ctrl-C interrupts, Ctrl-D leaves." +
      trust);
  auto* test = app.add_subcommand("test", "run every *_test.lua of a folder");
  test->add_option("DIR", said.test_path, "a folder, or one file")->required()->check(named);
  test->footer("Example:\n  clench test tests/lua" + trust);
  auto* doc = app.add_subcommand("doc", "write the pages of the Lua API and the editor's stub");
  doc->add_option("DIR", said.doc_folder, "folder to write to; default: docs/api, if it exists")
      ->check(named);
  doc->add_flag("--check", said.check_docs, "write nothing; fail if a page is out of date");
  doc->footer("Examples:\n  clench doc\n  clench doc --check");
  auto* describe = app.add_subcommand("describe", "print the description of a function or field");
  describe->add_option("NAME", said.described, "an entry of the Lua API; default: all")
      ->check(named);
  describe->add_flag("--json", said.describe_json, "as JSON");
  describe->footer(
      "Examples:\n  clench describe clench.plan.sample\n  clench describe --json hand:autograsp");
}

static void add_check(CLI::App& app, CheckOptions& check) {
  auto* verb = app.add_subcommand("check", "read files and report what was parsed");
  verb->add_option("FILE", check.files,
                   "robots, bodies, worlds, eigengrasps, virtual contacts, lists of grasps")
      ->required();
  add_reading(*verb, check.reading);
  verb->add_flag("--json", check.json, "as JSON");
  verb->footer(
      "Examples:\n  clench check hand.urdf\n  clench check --json mug.stl worlds/dlr_flask.wld\n\n"
      "Exit code: 1 if a file could not be read; with --strict also if something in one was "
      "repaired, is not used or looks wrong." +
      trust);
}

static void add_convert(CLI::App& app, ConvertOptions& convert) {
  auto* verb = app.add_subcommand("convert", "convert a file to another format");
  verb->add_option("IN", convert.from, "a file of any supported kind")->required();
  verb->add_option("OUT", convert.to, "file to write; its ending selects the format")->required();
  add_reading(*verb, convert.reading);
  verb->add_option("--format", convert.format,
                   "format of a list of grasps: jsonl csv npz isaac_grasp graspgen multigripper "
                   "graspit; of an .xml "
                   "world: mjcf graspit");
  verb->add_option("--dof-order", convert.dof_order,
                   "names of a list's DOFs, separated by commas, if the file has none");
  verb->footer(
      "Examples:\n  clench convert --unit mm mug.stl mug.xml\n"
      "  clench convert models/hands/barrett/barrett.cfg barrett.urdf\n"
      "  clench convert worlds/dlr_flask.wld dlr_flask.lua\n"
      "  clench convert --format graspgen grasps.jsonl grasps.json\n\n"
      "Warnings report everything that the new format cannot represent." +
      trust);
}

static void add_plan(CLI::App& app, PlanOptions& plan, bool plans) {
  auto* verb = app.add_subcommand("plan", "search for grasps of a hand on an object");
  add_plan_options(*verb, plan.words, plans);
  add_reading(*verb, plan.reading);
  verb->footer(
      "Examples:\n  clench plan models/hands/barrett/barrett.cfg models/objects/flask.iv -o "
      "flask.jsonl\n"
      "  clench plan --seconds 30 --unit mm hand.urdf mug.stl --obstacle table.iv --report "
      "mug.html\n\n"
      "Exit code: 1 if nothing was found, with the reason in the report; 130 after Ctrl-C, 143 "
      "after "
      "SIGTERM, 129 after SIGHUP, with the grasps so far written. See docs/guide/plan_command.md." +
      trust);
}

static void add_render(CLI::App& app, RenderVerbOptions& render) {
  auto* verb = app.add_subcommand("render", "draw a file or grasps of a list");
  add_render_options(*verb, render.words);
  add_reading(*verb, render.reading);
  verb->footer(
      "Examples:\n  clench render worlds/dlr_flask.wld -o flask.png\n"
      "  clench render flask.jsonl --pick 1,4,7 -o grasps.png\n"
      "  clench render flask.jsonl --pick 1 --background white --outline 1.5 -o figure.png\n\n"
      "Of a list, one picture per grasp, on a sheet if there are several. See "
      "docs/guide/pictures.md." +
      trust);
}

static void add_serve(CLI::App& app, ServeOptions& serve) {
  auto* verb = app.add_subcommand("serve", "serve a world to other programs");
  add_serve_options(*verb, serve.words);
  add_world_reading(*verb, serve.reading);
  verb->footer(
      "Examples:\n  clench serve worlds/barrett_mug.wld\n"
      "  clench serve worlds/barrett_mug.wld --socket /tmp/clench.socket\n"
      "  clench serve worlds/barrett_mug.wld --http 7000 --control\n\n"
      "Ctrl-C or SIGTERM ends it. See docs/guide/server.md." +
      trust);
}

static void add_mcp(CLI::App& app, ServeOptions& mcp) {
  auto* verb = app.add_subcommand("mcp", "offer a world to language models, over standard streams");
  mcp.verb = "mcp";
  add_mcp_options(*verb, mcp.words);
  add_world_reading(*verb, mcp.reading);
  verb->footer(
      "Examples:\n  clench mcp worlds/barrett_mug.wld\n"
      "  clench mcp --control worlds/barrett_mug.wld\n\n"
      "It is started by a program that speaks the Model Context Protocol, and ends with its input. "
      "See docs/guide/server.md." +
      trust);
}

static void add_view(CLI::App& app, ViewOptions& view) {
  auto* verb = app.add_subcommand("view", "show a world in a window");
  add_view_options(*verb, view.words);
  add_reading(*verb, view.reading);
  verb->footer(
      "Examples:\n  clench view worlds/barrett_mug.wld\n"
      "  clench view worlds/barrett_mug.wld --screenshot view.png\n\n"
      "See docs/guide/viewer.md." +
      trust);
}

// plans: a word of the command line may be the verb `plan`
static void add_all(CLI::App& app, Said& said, bool plans) {
  app.footer(
      "Examples:\n  clench run examples/01_first_grasp.lua\n  clench -e 'print(clench.version)'\n  "
      "clench -i scene.lua\n"
      "  clench repl\n\nExit code: 0 done, 1 failed, 2 wrong usage. `clench VERB --help` shows "
      "more.");
  app.set_version_flag("--version", "clench " CLENCH_VERSION);
  app.require_subcommand(0, 1);
  app.add_flag("-q,--quiet", said.run.quiet, "show errors only");
  app.add_option("-e", said.run.code, "run this code")->type_name("CODE")->allow_extra_args(false);
  app.add_option("-i", said.interactive, "run a script, then open a console")
      ->type_name("FILE")
      ->check(named);
  add_confine(app, said.confine);
  add_script_verbs(app, said);
  add_check(app, said.check);
  add_convert(app, said.convert);
  add_plan(app, said.plan, plans);
  add_render(app, said.render);
  add_serve(app, said.serve);
  add_mcp(app, said.mcp);
  add_view(app, said.view);
  for (CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() != "doc" && verb->get_name() != "describe")
      add_confine(*verb, said.confine);
    verb->fallthrough();
  }
}

// Prints an error if the first word should be a verb but is not.
static bool refuse_verb(const CLI::App& app, const std::string& first) {
  std::vector<std::string> verbs;
  for (const auto* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  if (first.front() == '-' || std::ranges::find(verbs, first) != verbs.end()) return false;
  const bool script = first.ends_with(".lua") || std::filesystem::exists(first);
  refuse(app, fmt::format(
                  "there is no verb '{}'{}", first,
                  script ? "; to run a script: clench run " + first : did_you_mean(first, verbs)));
  return true;
}

// runs scripts and consoles: the verbs run and repl, or no verb
static int run_scripts_of(const CLI::App& app, Said& said) {
  const bool repl = app.got_subcommand("repl"), terminal = isatty(STDIN_FILENO);
  const bool nothing =
      !repl && !app.got_subcommand("run") && said.run.code.empty() && said.interactive.empty();
  // clench < script.lua runs standard input, like Lua; in the background there is no input
  bool piped = false;
  if (nothing && !terminal) {
    const int first = std::getc(stdin);
    piped = first != EOF && std::ungetc(first, stdin) == first;
  }
  if (nothing && !piped && !terminal) {
    std::fputs(app.help().c_str(), stdout);
    return 0;
  }
  if (piped) said.run.file = "-";
  if (said.run.file.empty()) said.run.file = said.interactive;
  said.run.console = repl || !said.interactive.empty() || (nothing && !piped);
  return run_scripts(said.run);
}

static int run_verb(const CLI::App& app, Said& said) {
  for (std::string* folder :
       {&said.run.confine, &said.check.reading.confine, &said.convert.reading.confine,
        &said.plan.reading.confine, &said.render.reading.confine, &said.serve.reading.confine,
        &said.mcp.reading.confine, &said.view.reading.confine})
    *folder = said.confine;
  said.plan.quiet = said.serve.quiet = said.mcp.quiet = said.view.quiet = said.run.quiet;
  if (app.got_subcommand("test")) return run_tests(said.test_path, said.confine, said.run.quiet);
  if (app.got_subcommand("check")) return check_files(said.check);
  if (app.got_subcommand("convert")) return convert_file(said.convert);
  if (app.got_subcommand("plan")) return plan_grasps(said.plan);
  if (app.got_subcommand("render")) return render_file(said.render);
  if (app.got_subcommand("serve")) return serve_world(said.serve);
  if (app.got_subcommand("mcp")) return serve_world(said.mcp);
  if (app.got_subcommand("view")) return view_world(said.view);
  if (app.got_subcommand("describe")) return describe_entry(said.described, said.describe_json);
  if (app.got_subcommand("doc")) return write_docs(said.doc_folder, said.check_docs);
  return run_scripts_of(app, said);
}

static int main_of(int argc, char** argv) {
  CommandLine line = split(argc, argv);
  CLI::App app("Clench closes robot hands on objects and judges the grasps.", "clench");
  Said said;
  add_all(app, said, std::ranges::count(line.ours, "plan") > 0);
  if (!line.ours.empty()) {
    std::string& first = line.ours.front();
    if (first == "help" || first == "version") first.insert(0, "--");
    if (refuse_verb(app, first)) return 2;
  }
  try {
    // parse() expects the words in reverse order
    std::vector<std::string> words(line.ours.rbegin(), line.ours.rend());
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    // --help and --version are not errors
    if (e.get_exit_code() == 0) return app.exit(e);
    // an unknown word is usually the reason why something else is missing
    if (!app.remaining(true).empty()) return refuse_extra(app);
    std::string why = e.what();
    // message of CLI11: "--count: 1 required N:INTEGER missing"
    if (why.ends_with(" missing"))
      why = why.substr(0, why.find(':')) + ": expected a value, got none";
    return refuse(app, why);
  }
  said.run.arguments = line.script;
  return run_verb(app, said);
}

}  // namespace clench

int main(int argc, char** argv) {
  try {
    // a file that exceeds the size limit is an error of its writer and does not end the process
    std::signal(SIGXFSZ, [](int) {});
    const int code = clench::main_of(argc, argv);
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    pollfd output{STDOUT_FILENO, 0, 0};
    const bool unread = ::poll(&output, 1, 0) > 0 && (output.revents & POLLERR);
    std::fprintf(stderr, "clench: the output could not be written completely: %s\n",
                 unread ? "its reader is closed" : "is the disk full?");
    return code == 0 ? 1 : code;
  } catch (const std::bad_alloc&) {
    std::fputs("clench: not enough memory\n", stderr);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "clench: %s\n", clench::printable(e.what(), "\n\t").c_str());
  }
  return 1;
}
