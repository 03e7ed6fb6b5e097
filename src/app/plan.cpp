// `clench plan`: its behavior and output are implemented in stdlib/host/plan.lua.
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "clench/app/interrupt.h"
#include "clench/app/verbs.h"
#include "clench/base/printable.h"
#include "clench/script/host/state.h"

namespace clench {

using Words = std::vector<std::string>;

// a function of the module
static std::string call(State& state, const std::string& function, const Words& words = {},
                        const Interruptible* running = nullptr) {
  const auto result = state.call("host.plan", function, words);
  std::fflush(stdout);
  // a search ended by a signal needs no message
  const bool ended = running && running->pressed();
  if (!result.ok && !ended)
    fmt::print(stderr, "clench plan: {}\n", printable(result.error, "\n\t"));
  return result.ok && result.values.size() == 1 ? result.values.front() : "1";
}

// Searches, saves the list, then shows it. The first signal ends the search or the display, but not
// the saving between them; the second one ends the process.
static int run_plan(State& state, const Words& words) {
  int signal = 0;
  std::string done;
  {
    const Interruptible running(state, 2);
    done = call(state, "search", words, &running);
    signal = running.signal();
  }
  if (signal) done = call(state, "stopped");
  if (done == "finish") {
    {
      const Interruptible counting(signal ? 1 : 2);
      done = call(state, "save");
      if (!signal) signal = counting.signal();
    }
    const Interruptible running(state, signal ? 1 : 2);
    const std::string shown = call(state, "show", {}, &running);
    if (done == "0") done = shown;
    if (!signal) signal = running.signal();
  }
  return signal ? 128 + signal : std::atoi(done.c_str());
}

int plan_grasps(const PlanOptions& options) {
  State state;
  std::string exit_asked;  // no script is running
  state.refuse_exit(exit_asked);
  if (options.quiet) state.set_quiet();
  if (!options.reading.confine.empty()) state.set_confine(options.reading.confine);
  catch_interrupts();
  catch_endings();
  std::signal(SIGPIPE,
              [](int) {});  // a closed output pipe must not prevent files from being written
  Words words = words_of(options.reading);
  words.insert(words.end(), options.words.begin(), options.words.end());
  // without a terminal, progress is written as a line from time to time
  if (!options.quiet && !isatty(STDERR_FILENO)) words.insert(words.end(), {"lines", "yes"});
  return run_plan(state, words);
}

}  // namespace clench
