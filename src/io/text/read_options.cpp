#include "clench/io/text/read_options.h"

#include "clench/base/error.h"

namespace clench {

ReadOptions ReadOptions::beside_only() const {
  ReadOptions out = *this;
  out.root.clear();
  out.folder.clear();
  return out;
}

ReadOptions strict(ReadOptions options) {
  options.warn = options.repair =
      options.suspect = [](const std::string& sentence) { throw Error(sentence); };
  return options;
}

}  // namespace clench
