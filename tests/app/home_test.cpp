// Shipped models and worlds are found from any folder, and before foreign files of the same name.
#include "command.h"

using namespace clench::test;

static const std::string loads =
    "-q -e 'local w = clench.load \"worlds/barrett_mug.wld\" w:add_object "
    "\"models/objects/cube.iv\" "
    "print(#w.objects, clench.file_kind \"worlds/barrett_mug.wld\")'";

TEST_CASE("names of shipped models and worlds load from any folder") {
  const Folder elsewhere;
  const std::string there = "cd " + (elsewhere / ".") + " &&";
  CHECK(run(loads, "", there).out == "2\tworld\n");
  CHECK(run("check worlds/barrett_mug.wld", "", there).code == 0);
  CHECK(has(run("-e 'clench.load \"barrett_mug.wld\"'", "", there).out, "no such file"));
  CHECK(has(run("-e 'clench.load \"worlds/barret_mug.wld\"'", "", there).out,
            "did you mean 'barrett_mug.wld'?"));
  // an existing file in the current folder takes precedence, and confined reading stays confined
  elsewhere.file("worlds/barrett_mug.wld", "not a world");
  CHECK(run(loads, "", there).code == 1);
  CHECK(has(run("--confine worlds -e 'clench.load \"worlds/dlr_flask.wld\"'", "", there).out,
            "no such file"));
}

TEST_CASE("an installed Clench finds its own models, whatever folders lie above its prefix") {
  const Folder folder;
  const fs::path top = folder / ".";
  fs::create_directories(top / "prefix/bin");
  fs::create_directories(top / "prefix/share/clench");
  fs::copy_file(CLENCH_COMMAND, top / "prefix/bin/clench");
  for (const char* shelf : {"models", "worlds"})
    fs::create_directory_symlink(fs::absolute(shelf), top / "prefix/share/clench" / shelf);
  folder.file("models/objects/cube.iv", "a stranger's");
  folder.file("worlds/barrett_mug.wld", "a stranger's");
  const Folder elsewhere;
  const std::string there = "cd " + (elsewhere / ".") + " && " + (folder / "prefix/bin/clench");
  // the installed command, not the one in the build folder
  CHECK(run("", "", there + " " + loads + "; true").out == "2\tworld\n");
  // also while the file of the command is being replaced, as a build does
  const std::string replaced = " -q -e 'os.remove \"" + (folder / "prefix/bin/clench") +
                               "\" print(clench.file_kind \"worlds/barrett_mug.wld\")'; true";
  CHECK(run("", "", there + replaced).out == "world\n");
}
