// Verbs that read files; their behavior and output are implemented in stdlib/host.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "clench/app/interrupt.h"
#include "clench/app/verbs.h"
#include "clench/base/printable.h"
#include "clench/script/host/state.h"

namespace clench {

std::vector<std::string> words_of(const ReadingOptions& reading) {
  return {reading.root, reading.folder, reading.package, reading.unit,
          reading.strict ? "strict" : ""};
}

// `main` of stdlib/host/<verb>.lua returns the exit code
static int run_in_state(const std::string& verb, std::vector<std::string> arguments,
                        const ReadingOptions& reading, std::string& exit_asked) {
  State state;
  state.refuse_exit(exit_asked);
  if (!reading.confine.empty()) state.set_confine(reading.confine);
  catch_interrupts();
  const Interruptible running(state, 2);
  const auto said = words_of(reading);
  arguments.insert(arguments.begin(), said.begin(), said.end());
  const auto result = state.call("host." + verb, "main", arguments);
  std::fflush(stdout);
  if (!result.ok) fmt::print(stderr, "clench {}: {}\n", verb, printable(result.error, "\n\t"));
  if (running.pressed()) return 130;
  return result.ok && result.values.size() == 1 ? std::atoi(result.values[0].c_str()) : 1;
}

static int run_host(const std::string& verb, const std::vector<std::string>& arguments,
                    const ReadingOptions& reading) {
  // finalizers run when the state is closed, and may check for interrupts, too
  std::string exit_asked;
  const int code = run_in_state(verb, arguments, reading, exit_asked);
  if (code != 0 || exit_asked.empty()) return code;
  std::fprintf(stderr, "clench %s: %s\n", verb.c_str(), exit_asked.c_str());
  return 1;
}

int describe_entry(const std::string& name, bool json) {
  return run_host("describe", {json ? "json" : "text", name}, {});
}

int check_files(const CheckOptions& options) {
  std::vector<std::string> arguments = options.files;
  arguments.insert(arguments.begin(), options.json ? "json" : "text");
  return run_host("check", arguments, options.reading);
}

int render_file(const RenderVerbOptions& options) {
  return run_host("render", options.words, options.reading);
}

int convert_file(const ConvertOptions& options) {
  return run_host("convert", {options.from, options.to, options.format, options.dof_order},
                  options.reading);
}

}  // namespace clench
