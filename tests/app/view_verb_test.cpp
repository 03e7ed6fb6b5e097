// `clench view`: one frame as a picture, and rejected arguments. The window is tested in
// tests/scripts.
#include <algorithm>

#include "command.h"

using namespace clench::test;

namespace {

const std::string no_display = "env -u DISPLAY -u WAYLAND_DISPLAY";

// exactly one sentence on stderr
void refused(const Outcome& outcome, int code, const std::string& sentence) {
  CHECK(outcome.code == code);
  CHECK(has(outcome.out, sentence));
  CHECK(std::count(outcome.out.begin(), outcome.out.end(), '\n') == 1);
}

}  // namespace

TEST_CASE("view writes one frame without a display") {
  const Folder folder;
  const std::string path = folder / "frame.png";
  const auto outcome = run(
      "view worlds/barrett_mug.wld --root . --size 320x240 --screenshot " + path, "", no_display);
  if (outcome.code == 0) {
    CHECK(has(outcome.out, path + ": 320 x 240 pixels"));
    CHECK(fs::file_size(path) > 5000);
  } else {
    CHECK(outcome.code == 1);
    CHECK(has(outcome.out, "OpenGL"));
  }
}

TEST_CASE("without a display, view and a console with --view report that") {
  for (const std::string arguments : {"view worlds/barrett_mug.wld --root .", "repl --view"})
    refused(run(arguments, "", no_display), 1, "the viewer cannot open a window: ");
}

TEST_CASE("without libglfw, view names the package") {
  const Folder folder;
  folder.file("libglfw.so.3", "no library");
  refused(run("view", "", "env LD_LIBRARY_PATH=" + (folder / "")), 1,
          "install the package libglfw3");
}

TEST_CASE("view rejects files, scripts and sizes in one sentence") {
  refused(run("view no_such.wld"), 1, "no such file: no_such.wld");
  refused(run("view README.md"), 1, "expected a model, a world");
  refused(run("view --size 4x4"), 2, "--size: expected 16 to 8192 pixels, got '4x4'");
  refused(run("view --size big"), 2, "--size: expected width and height in pixels");
  refused(run("view --screenshot no/such/a.png"), 1, "no such folder: no/such");
  refused(run("view --screenshot a.txt"), 2, "--screenshot: expected a file .png");
  const Folder folder;
  const std::string script = folder / "none.lua", out = folder / "a.png";
  const auto outcome = run("view --script " + script + " --screenshot " + out);
  const bool draws = outcome.out.find("OpenGL") == std::string::npos;
  refused(outcome, 1, draws ? "--script: cannot open " + script : "OpenGL");
}
