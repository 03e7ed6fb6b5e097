// `clench view`: its behavior and output are implemented in stdlib/host/view.lua.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "clench/app/interrupt.h"
#include "clench/app/verbs.h"
#include "clench/base/printable.h"
#include "clench/script/host/state.h"

namespace clench {

int view_world(const ViewOptions& options) {
  State state;
  if (options.quiet) state.set_quiet();
  if (!options.reading.confine.empty()) state.set_confine(options.reading.confine);
  catch_interrupts();
  catch_endings();
  std::vector<std::string> words = words_of(options.reading);
  words.insert(words.end(), options.words.begin(), options.words.end());
  const Interruptible running(state, 2);
  const auto result = state.call("host.view", "main", words);
  std::fflush(stdout);
  if (running.pressed()) return 128 + running.signal();
  if (!result.ok) fmt::print(stderr, "clench view: {}\n", printable(result.error, "\n\t"));
  return result.ok && result.values.size() == 1 ? std::atoi(result.values[0].c_str()) : 1;
}

}  // namespace clench
