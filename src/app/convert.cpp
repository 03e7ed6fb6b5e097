#include <cstdio>

#include "app/interrupt.h"
#include "app/verbs.h"
#include "script/state.h"

namespace clench {

int convert_file(const ConvertOptions& options) {
  State state;
  catch_interrupts();
  const Interruptible running(state);
  const ReadingOptions& reading = options.reading;
  const auto result = state.call(
      "host.convert", "file",
      {options.from, options.to, reading.root, reading.folder, reading.package, reading.unit});
  const bool wrong = result.ok && !result.values.empty() && result.values[0] != "nil";
  if (result.ok && !wrong) return 0;
  const std::string& sentence = wrong ? result.values[0] : result.error;
  std::fprintf(stderr, "clench convert: %s\n", sentence.c_str());
  return 1;
}

}  // namespace clench
