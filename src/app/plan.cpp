// `clench plan`: what it does and says is in stdlib/host/plan.lua.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "clench/app/interrupt.h"
#include "clench/app/verbs.h"
#include "clench/base/printable.h"
#include "clench/script/host/state.h"

namespace clench {

using Words = std::vector<std::string>;

// a function of the module, which the first Ctrl-C interrupts and the second ends
static std::string call(State& state, const std::string& function, const Words& words) {
  const Interruptible running(state, 2);
  const auto result = state.call("host.plan", function, words);
  std::fflush(stdout);
  if (!result.ok) fmt::print(stderr, "clench plan: {}\n", printable(result.error, "\n\t"));
  return result.ok && result.values.size() == 1 ? result.values.front() : "1";
}

int plan_grasps(const PlanOptions& options) {
  State state;
  std::string exit_asked;  // no script runs here
  state.refuse_exit(exit_asked);
  if (options.quiet) state.set_quiet();
  if (!options.reading.confine.empty()) state.set_confine(options.reading.confine);
  catch_interrupts();
  Words words = words_of(options.reading);
  words.insert(words.end(), options.words.begin(), options.words.end());
  std::string done = call(state, "search", words);
  // what an interrupted search has found is written in a run that Ctrl-C has not touched
  if (done == "finish" || done == "interrupted") done = call(state, "finish", {done});
  return std::atoi(done.c_str());
}

}  // namespace clench
