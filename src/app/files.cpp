// The verbs that read files: what they do and say is in stdlib/host.
#include <fmt/format.h>

#include <cstdio>

#include "app/interrupt.h"
#include "app/verbs.h"
#include "script/state.h"

namespace clench {

// `main` of stdlib/host/<verb>.lua returns the exit code
static int run_host(const std::string& verb, std::vector<std::string> arguments,
                    const ReadingOptions& reading) {
  State state;
  catch_interrupts();
  const Interruptible running(state);
  arguments.insert(arguments.begin(),
                   {reading.root, reading.folder, reading.package, reading.unit});
  const auto result = state.call("host." + verb, "main", arguments);
  std::fflush(stdout);
  if (!result.ok) fmt::print(stderr, "clench {}: {}\n", verb, result.error);
  return result.ok && result.values == std::vector<std::string>{"0"} ? 0 : 1;
}

int check_files(const CheckOptions& options) {
  std::vector<std::string> arguments = options.files;
  arguments.insert(arguments.begin(), options.json ? "json" : "text");
  return run_host("check", arguments, options.reading);
}

int convert_file(const ConvertOptions& options) {
  return run_host("convert", {options.from, options.to}, options.reading);
}

}  // namespace clench
