// The list that `clench plan -o` writes: kept, replaced, resumed and rejected.
#include <sys/stat.h>

#include <algorithm>

#include "plan_command.h"

using namespace clench::test;

TEST_CASE(
    "a search that is killed, truncated, stopped and resumed finds the same grasps as an "
    "uninterrupted one") {
  const Folder folder;
  const std::string out = folder / "a.jsonl", other = folder / "b.jsonl";
  const std::string command = barrett + "--no-verify --seed 3 -o " + out;
  CHECK(has(end_by("KILL", command + " --threads 1 --count 12", out), "code 137"));
  // the rest of a truncated line is read, with a warning
  const std::string text = text_of(out);
  folder.file("a.jsonl", text.substr(0, text.size() - 100));
  CHECK(has(epsilons(out) + run("-e 'clench.grasps(\"" + out + "\")'").out,
            "the last line is cut short and is skipped"));
  CHECK(has(end_by("TERM", command + " --threads 1 --resume", out), "code 143"));
  const auto rest = run(command + " --resume");
  CHECK(rest.code == 0);
  CHECK(has(rest.out, "64 candidates in "));
  CHECK(!fs::exists(out + ".search"));
  CHECK(run(barrett + "--no-verify --seed 3 --threads 1 --count 12 -o " + other).code == 0);
  CHECK(text_of(out) == text_of(other));
  // a complete search has no work left
  const auto done = run(command + " --resume --count 12");
  CHECK(done.code == 0);
  CHECK(has(done.out, "a.jsonl: the search is complete\n"));
  CHECK(text_of(out) == text_of(other));
}

TEST_CASE("a search is written in several formats at once") {
  const Folder folder;
  const std::string lines = folder / "a.jsonl", table = folder / "a.csv", arrays = folder / "a.npz",
                    other = folder / "a.json";
  const std::string command = barrett + "--no-verify --count 2 -o " + table + " -o " + lines +
                              " -o " + arrays + " -o " + other + " --format graspgen";
  CHECK(run(command).code == 0);
  CHECK(epsilons(lines).size() > 4);
  CHECK(epsilons(table) == epsilons(lines));
  CHECK(epsilons(arrays) == epsilons(lines));
  CHECK(has(text_of(other), "transforms"));
  const auto refused = run(command);
  CHECK(refused.code == 1);
  CHECK(has(refused.out, "-o: " + table + " exists already; --overwrite replaces it"));
  CHECK(run(command + " --overwrite").code == 0);
  const auto twice = run(barrett + "-o " + lines + " -o " + lines);
  CHECK(twice.code == 2);
  CHECK(has(twice.out, "-o: " + lines + " is given twice"));
  const auto dotted = run(barrett + "-o " + lines + " -o /." + lines);
  CHECK(dotted.code == 2);
  CHECK(has(dotted.out, "is given twice"));
}

TEST_CASE("an existing list is replaced or continued only on request") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  const std::string command = barrett + "--no-verify --count 1 -o " + out;
  CHECK(run(command).code == 0);
  const std::string list = text_of(out);
  const auto refused = [&](const std::string& arguments, const std::string& sentence,
                           int code = 1) {
    const auto result = run(arguments);
    CAPTURE(result.out);
    CHECK(result.code == code);
    CHECK(has(result.out, sentence));
    CHECK(text_of(out) == list);
    CHECK(result.out.find("candidates") == std::string::npos);
  };
  refused(command,
          "-o: " + out +
              " is the list of this search: --resume continues it, --overwrite restarts it\n");
  refused(command + " --seed 2",
          " is the list of another search: expected --seed '2', got '1'; --overwrite replaces it");
  refused(command + " --seed 2 --resume",
          "--resume: " + out + " is of another search: expected --seed");
  refused(command + " --contacts power", "expected --contacts 'power', got 'any'");
  refused(command + " --distance 0.2", "expected --distance '0.2', got '0.1'");
  // defaults that are given, as other text for the same numbers, are the same search
  refused(command + " --distance 1e-1 --contacts any --seed +1", " is the list of this search");
  std::string without = list;
  const std::string stated = R"("distance":"0.1",)";
  REQUIRE(without.find(stated) != std::string::npos);
  without.erase(without.find(stated), stated.size());
  const auto shorter = folder.file("without.jsonl", without);
  CHECK(has(run(barrett + "--no-verify --count 1 -o " + shorter).out,
            shorter + " is the list of this search"));
  refused(command + " --mass 0.2", "expected --mass '0.2', got none");
  refused(barrett + "-o " + out, "expected no --no-verify, got --no-verify");
  refused("plan models/hands/barrett/barrett.cfg models/objects/mug.iv --no-verify -o " + out,
          "expected OBJECT 'models/objects/mug.iv', got 'models/objects/flask.iv'");
  refused("plan models/hands/dlr/dlr.cfg models/objects/flask.iv --no-verify --resume -o " + out,
          "expected HAND 'models/hands/dlr/dlr.cfg', got 'models/hands/barrett/barrett.cfg'");
  refused(command + " --resume --overwrite", "expected --overwrite or --resume, got both", 2);
  refused(barrett + "--resume", "--resume requires -o FILE", 2);
  refused(barrett + "--overwrite", "--overwrite requires -o FILE", 2);
  refused(barrett + "--resume -o " + (folder / "a.csv"),
          "--resume: expected a list of JSON lines, -o FILE.jsonl, got '" + (folder / "a.csv"), 2);
  // the same search, with other spellings of its options
  refused(command + " --seed 01 --contacts any --pose 0,0,0 --threads 1",
          "is the list of this search");
  // other files
  const auto other = [&](const std::string& name, const std::string& text,
                         const std::string& sentence) {
    const std::string path = folder.file(name, text);
    refused(barrett + "-o " + path, "-o: " + path + sentence);
    CHECK(text_of(path) == text);
  };
  other("b.jsonl", "mine\n", " exists already; --overwrite replaces it");
  other("b.csv", "mine\n", " exists already; --overwrite replaces it");
  other("c.jsonl", "{\"format\":\"clench grasps\",\"version\":1}\n{\"hand\":1}\n",
        " exists already and does not identify its search; --overwrite replaces it");
  refused(barrett + "--resume -o " + (folder / "b.jsonl"), "b.jsonl is not a list of grasps");
  const std::string replaced = folder / "b.jsonl";
  CHECK(run(command.substr(0, command.find("-o")) + "--overwrite -o " + replaced).code == 0);
  CHECK(text_of(replaced) == list);
}

TEST_CASE("a search that fails or finds nothing leaves files unchanged") {
  const Folder folder;
  std::string outputs;
  const std::pair<const char*, const char*> files[] = {{"-o", "a.jsonl"}, {"--sheet", "a.png"}};
  for (const auto& [option, name] : files)
    outputs += fmt::format(" {} {}", option, folder.file(name, "old"));
  const auto check_old = [&] {
    for (const auto& [option, name] : files) CHECK(text_of(folder / name) == "old");
    CHECK(std::distance(fs::directory_iterator(folder / "."), fs::directory_iterator()) == 2);
  };
  const auto misspelt = run("plan models/hands/barrett/barrett.cfg flsk.stl --overwrite" + outputs);
  CHECK(misspelt.code == 1);
  CHECK(has(misspelt.out, "no such file: flsk.stl"));
  check_old();
  CHECK(run(barrett + "--overwrite --obstacle no.iv" + outputs).code == 1);
  check_old();
  const Folder elsewhere;
  const auto object = elsewhere.file("cube.obj", cube_of(1));
  const auto none = run("plan models/hands/parallel_jaw/parallel_jaw.cfg " + object +
                        " --unit m --seconds 0.2 --overwrite" + outputs);
  CHECK(none.code == 1);
  CHECK(has(none.out, "a.jsonl is unchanged, as no grasps were found\n"));
  CHECK(has(none.out, "a.png is unchanged, as no grasps were found\n"));
  check_old();
}

TEST_CASE("plan does not write its list to pipes, devices or folders") {
  const Folder folder;
  for (const char* name : {"pipe.jsonl", "pipe.png", "pipe.html", "pipe.csv"})
    REQUIRE(mkfifo((folder / name).c_str(), 0600) == 0);
  fs::create_directory(folder / "folder.png");
  const auto refused = [&](const std::string& option, const std::string& sentence) {
    const auto result = run(barrett + option);
    CHECK(result.code == 1);
    CHECK(has(result.out, sentence));
  };
  const std::string sentence = ": expected a file to write, got a special file\n";
  for (const std::string option : {"-o pipe.jsonl", "-o pipe.csv", "--sheet pipe.png"}) {
    const size_t space = option.find(' ');
    const std::string path = folder / option.substr(space + 1);
    refused(option.substr(0, space + 1) + path, path + sentence);
  }
  refused("-o /dev/full", "/dev/full" + sentence);
  refused("-o /dev/stdout > " + (folder / "out") + " 2>&1; cat " + (folder / "out") + "; exit 1",
          "-o: /dev/stdout" + sentence);
  refused("--sheet " + (folder / "folder.png"), "expected a file to write, got a folder");
  const auto page = run(barrett + "--report " + (folder / "pipe.html"));
  CHECK(page.code == 1);
  CHECK(has(page.out, sentence));
}

TEST_CASE("on a full disk a search ends, prints its grasps, and reports the error once") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  // a limit in blocks of 512 or 1024 bytes that a few grasps fit in
  const auto result = run(barrett + "--no-verify --count 60 -o " + out, "", "ulimit -f 48;");
  CHECK(result.code == 1);
  CHECK(has(result.out, "clench plan: " + out + ": the file cannot be written: File too large\n"));
  CHECK(has(result.out, "  epsilon  load"));
  CHECK(result.out.find("cannot be written") == result.out.rfind("cannot be written"));
  const std::string text = text_of(out), list = epsilons(out);
  CHECK(text.ends_with("}\n"));
  CHECK(std::count(list.begin(), list.end(), '\n') >= 1);
  CHECK(list.find("clench") == std::string::npos);
}

TEST_CASE("a list that another program has replaced meanwhile is not overwritten") {
  const Folder folder;
  const std::string out = folder / "a.jsonl", theirs = folder.file("theirs", "theirs\n");
  const std::string text =
      output_of(std::string(CLENCH_COMMAND) + " " + barrett + "--no-verify --count 100000 -o " +
                out + " & pid=$!\nwhile [ ! -s " + out + " ]; do sleep 0.05; done\nmv " + theirs +
                " " + out + "\nwait $pid\necho code $?\n");
  CHECK(has(text, "a.jsonl was replaced by another program: it is not written\n"));
  CHECK(has(text, "  epsilon  load"));
  CHECK(has(text, "code 1\n"));
  CHECK(text_of(out) == "theirs\n");
}

TEST_CASE("a closed output pipe does not keep plan from writing its files") {
  const Folder folder;
  const std::string out = folder / "a.jsonl";
  const std::string text =
      output_of("{ " + std::string(CLENCH_COMMAND) + " " + barrett + "--no-verify --count 1 -o " +
                out + "; echo code $? >&2; } | true\n");
  CHECK(has(text, "clench: the output could not be written completely: its reader is closed\n"));
  CHECK(has(text, "code 1\n"));
  CHECK(std::stod(epsilons(out)) > 0);
}
