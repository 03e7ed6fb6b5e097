#include "clench/app/repl.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>

#include "clench/app/interrupt.h"
#include "clench/app/line.h"
#include "clench/base/printable.h"
#include "clench/script/host/state.h"
#include "clench/script/lua/home.h"

namespace clench {

namespace fs = std::filesystem;

static State::Line run_chunk(State& state, const std::string& chunk, int line = 1) {
  const Interruptible running(state, 3);
  const auto outcome = state.evaluate(chunk, line);
  std::fflush(stdout);
  return outcome;
}

static bool leaves(const std::string& line) {
  return line == "exit" || line == "quit" || line == "exit()" || line == "quit()";
}

// reads chunks from input that is not a terminal
static int run_piped(State& state) {
  std::string chunk, line;
  bool open = false;
  int begin = 1;  // line of the input at which the chunk begins
  for (int number = 1; std::getline(std::cin, line); ++number) {
    if (!open && leaves(line)) return 0;
    if (!open) begin = number;
    chunk = open ? chunk + "\n" + line : line;
    open = run_chunk(state, chunk, begin) == State::Line::incomplete;
  }
  if (!open) return 0;
  std::fputs("clench repl: the input ended inside a chunk\n", stderr);
  return 1;
}

static void add_names(const fs::path& folder, const std::string& typed,
                      std::vector<std::string>& names) {
  std::error_code none;
  for (fs::directory_iterator at(folder, none), end; !none && at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with(typed) && (name[0] != '.' || typed.starts_with('.')))
      names.push_back(at->is_directory(none) ? name + "/" : name);
  }
}

// the beginning of a path's last name, then its completions: in this state, otherwise in the
// catalog
static std::vector<std::string> file_names(const std::string& path) {
  const size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  const std::string typed = slash == std::string::npos ? path : path.substr(slash + 1);
  std::vector<std::string> names;
  add_names(folder.empty() ? "." : folder, typed, names);
  const fs::path home = home_folder();
  if (names.empty() && !home.empty() &&
      (folder.starts_with("models/") || folder.starts_with("worlds/")))
    add_names(home / folder, typed, names);
  std::sort(names.begin(), names.end());
  names.insert(names.begin(), typed);
  return names;
}

// the event loop, which runs while the prompt waits
static LineEditor::Background background_of(State& state) {
  const auto descriptor = state.call("host.prompt", "descriptor", {});
  if (!descriptor.ok) return {};
  const auto run = [&state] {
    const Interruptible running(state, 3);
    const auto outcome = state.call("host.prompt", "run", {});
    if (!outcome.ok) fmt::print(stderr, "{}\n", printable(outcome.error, "\n\t"));
  };
  return {std::stoi(descriptor.values.at(0)), run};
}

static int run_terminal(State& state) {
  const auto complete = [&state](const std::string& line) {
    const auto words = state.call("host.complete", "words", {line}).values;
    const bool file = words.size() == 1 && words[0].starts_with('\1');
    return file ? file_names(words[0].substr(1)) : words;
  };
  LineEditor editor(history_file(), complete, background_of(state));
  std::puts("Clench " CLENCH_VERSION
            ", Lua 5.4. Tab completes, help(x) explains, Ctrl-D or exit leaves.");
  std::string chunk, line;
  bool open = false;
  for (;;) {
    const auto key = editor.read(open ? ">> " : "> ", line);
    if (key == LineEditor::Key::end) break;
    if (key == LineEditor::Key::interrupted) {
      open = false;
      continue;
    }
    if (!open && leaves(line)) return 0;
    chunk = open ? chunk + "\n" + line : line;
    open = run_chunk(state, chunk) == State::Line::incomplete;
    if (!open) editor.remember(chunk);
  }
  std::fputc('\n', stdout);
  return 0;
}

int run_console(State& state) {
  state.call("host.help", "install", {});
  return isatty(STDIN_FILENO) ? run_terminal(state) : run_piped(state);
}

}  // namespace clench
