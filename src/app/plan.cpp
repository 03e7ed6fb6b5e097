// `clench plan`: what it does and says is in stdlib/host/plan.lua.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "clench/app/interrupt.h"
#include "clench/app/verbs.h"
#include "clench/script/host/state.h"

namespace clench {

using Words = std::vector<std::string>;

// what the options say, as pairs of a name and a value
static Words words_of(const PlanOptions& options) {
  const ReadingOptions& reading = options.reading;
  Words words = {reading.root, reading.folder, reading.package, reading.unit,
                 reading.strict ? "strict" : ""};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {name, value});
  };
  add("hand", options.hand);
  add("object", options.object);
  for (const auto& path : options.obstacles) add("obstacle", path);
  for (const auto& pose : options.obstacle_poses) add("obstacle-pose", pose);
  add("pose", options.pose);
  add("mass", options.mass);
  add("count", options.count);
  add("seconds", options.seconds);
  add("seed", options.seed);
  add("threads", options.threads);
  add("verify", options.shaken ? "yes" : "");
  add("keep-lost", options.keep_lost ? "yes" : "");
  add("contacts", options.contacts);
  add("force-ratio", options.force_ratio);
  add("no-verify", options.unverified ? "yes" : "");
  add("o", options.out);
  add("format", options.format);
  add("report", options.report);
  add("sheet", options.sheet);
  return words;
}

// a function of the module, which the first Ctrl-C interrupts and the second ends
static std::string call(State& state, const std::string& function, const Words& words) {
  const Interruptible running(state, 2);
  const auto result = state.call("host.plan", function, words);
  std::fflush(stdout);
  if (!result.ok) fmt::print(stderr, "clench plan: {}\n", result.error);
  return result.ok && result.values.size() == 1 ? result.values.front() : "1";
}

int plan_grasps(const PlanOptions& options) {
  State state;
  std::string exit_asked;  // no script runs here
  state.refuse_exit(exit_asked);
  if (options.quiet) state.set_quiet();
  if (!options.reading.confine.empty()) state.set_confine(options.reading.confine);
  catch_interrupts();
  std::string done = call(state, "search", words_of(options));
  // what an interrupted search has found is written in a run that Ctrl-C has not touched
  if (done == "finish" || done == "interrupted") done = call(state, "finish", {done});
  return std::atoi(done.c_str());
}

}  // namespace clench
