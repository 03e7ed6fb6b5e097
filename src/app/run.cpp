#include <fmt/format.h>

#include <cstdio>

#include "clench/app/interrupt.h"
#include "clench/app/repl.h"
#include "clench/app/verbs.h"
#include "clench/base/printable.h"
#include "clench/script/host/state.h"

namespace clench {

static bool report(const State::Result& result) {
  std::fflush(stdout);
  if (!result.ok) fmt::print(stderr, "clench: {}\n", printable(result.error, "\n\t"));
  return result.ok;
}

int run_scripts(const RunOptions& options) {
  State state;
  if (options.quiet) state.set_quiet();
  if (!options.confine.empty()) state.set_confine(options.confine);
  state.set_script("here");  // typed or piped code is treated as a script in the current folder
  catch_interrupts();
  if (!options.console) catch_endings();
  // expressions given on the command line run like those typed at the console
  if (!options.code.empty()) state.call("host.help", "install", {});
  bool ok = true;
  int signal = 0;
  {
    const Interruptible running(state, 2);
    for (const auto& code : options.code) ok = ok && report(state.run_code(code, "=-e"));
    if (ok && !options.file.empty()) ok = report(state.run_file(options.file, options.arguments));
    signal = running.signal();
  }
  if (options.view && !report(state.call("host.view", "beside", {}))) return 1;
  // a console also opens after errors, to inspect the state
  if (options.console) return run_console(state);
  // as a shell reports a program that was ended by a signal
  if (signal) return 128 + signal;
  return ok ? 0 : 1;
}

}  // namespace clench
