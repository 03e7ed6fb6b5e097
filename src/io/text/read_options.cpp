#include "clench/io/text/read_options.h"

#include "clench/base/placed_error.h"

namespace clench {

ReadOptions ReadOptions::beside_only() const {
  ReadOptions out = *this;
  out.root.clear();
  out.folder.clear();
  return out;
}

ReadOptions strict(ReadOptions options) {
  options.diagnostics = Diagnostics([before = options.diagnostics](const Diagnostic& d) {
    if (d.severity != Severity::note) throw PlacedError(d.place, d.message());
    before.note(d);
  });
  return options;
}

}  // namespace clench
