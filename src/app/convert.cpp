#include <cstdio>

#include "app/interrupt.h"
#include "app/verbs.h"
#include "script/state.h"

namespace clench {

int convert_file(const ConvertOptions& options) {
  State state;
  catch_interrupts();
  const Interruptible running(state);
  const auto result =
      state.call("host.convert", "file", {options.from, options.to, options.root, options.unit});
  if (result.ok) return 0;
  std::fprintf(stderr, "clench convert: %s\n", result.error.c_str());
  return 1;
}

}  // namespace clench
