#include <cstdio>
#include <cstdlib>

#include "app/interrupt.h"
#include "app/verbs.h"
#include "script/state.h"

namespace clench {

int check_files(const CheckOptions& options) {
  State state;
  catch_interrupts();
  const Interruptible running(state);
  const ReadingOptions& reading = options.reading;
  std::vector<std::string> arguments{options.json ? "json" : "text", reading.root, reading.folder,
                                     reading.package, reading.unit};
  arguments.insert(arguments.end(), options.files.begin(), options.files.end());
  const auto result = state.call("host.check", "files", arguments);
  std::fflush(stdout);
  if (result.ok && result.values.size() == 1) return std::atoi(result.values[0].c_str()) ? 1 : 0;
  std::fprintf(stderr, "clench check: %s\n", result.error.c_str());
  return 1;
}

}  // namespace clench
