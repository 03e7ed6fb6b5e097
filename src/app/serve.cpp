// `clench serve` and `clench mcp`: their behavior and output are implemented in stdlib/host/serve.lua.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "clench/app/interrupt.h"
#include "clench/app/verbs.h"
#include "clench/base/printable.h"
#include "clench/script/host/state.h"

namespace clench {

int serve_world(const ServeOptions& options) {
  State state;
  std::string exit_asked;  // an error in a world in Lua does not end the server
  state.refuse_exit(exit_asked);
  if (options.quiet) state.set_quiet();
  if (!options.reading.confine.empty()) state.set_confine(options.reading.confine);
  catch_interrupts();
  catch_endings();
  std::signal(SIGPIPE, [](int) {});  // a closed output pipe does not end the server
  std::vector<std::string> words = words_of(options.reading);
  words.insert(words.end(), {"verb", options.verb});
  words.insert(words.end(), options.words.begin(), options.words.end());
  const Interruptible running(state, 2);
  const auto result = state.call("host.serve", "main", words);
  std::fflush(stdout);
  // a signal is the regular end of a server
  if (running.pressed()) return 0;
  if (!result.ok)
    fmt::print(stderr, "clench {}: {}\n", options.verb, printable(result.error, "\n\t"));
  return result.ok && result.values.size() == 1 ? std::atoi(result.values[0].c_str()) : 1;
}

}  // namespace clench
