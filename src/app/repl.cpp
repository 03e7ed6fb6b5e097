#include "clench/app/repl.h"

#include <unistd.h>

#include <cstdio>
#include <functional>
#include <iostream>
#include <string>

#include "clench/app/interrupt.h"
#include "clench/app/line.h"
#include "clench/script/host/state.h"

namespace clench {

static State::Line run_chunk(State& state, const std::string& chunk, int line = 1) {
  const Interruptible running(state);
  const auto outcome = state.evaluate(chunk, line);
  std::fflush(stdout);
  return outcome;
}

// chunks from anything that is no terminal
static int run_piped(State& state) {
  std::string chunk, line;
  bool open = false;
  int begin = 1;  // the chunk's first line in the input
  for (int number = 1; std::getline(std::cin, line); ++number) {
    if (!open) begin = number;
    chunk = open ? chunk + "\n" + line : line;
    open = run_chunk(state, chunk, begin) == State::Line::incomplete;
  }
  if (!open) return 0;
  std::fputs("clench repl: the input ended inside a chunk\n", stderr);
  return 1;
}

static int run_terminal(State& state) {
  const auto complete = [&state](const std::string& line) {
    return state.call("host.complete", "words", {line}).values;
  };
  LineEditor editor(history_file(), complete);
  std::puts("Clench " CLENCH_VERSION ", Lua 5.4. Tab completes, help(x) explains, Ctrl-D leaves.");
  std::string chunk, line;
  bool open = false;
  for (;;) {
    const auto key = editor.read(open ? ">> " : "> ", line);
    if (key == LineEditor::Key::end) break;
    if (key == LineEditor::Key::interrupted) {
      open = false;
      continue;
    }
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
