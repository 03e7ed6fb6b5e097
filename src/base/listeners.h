// Callbacks for the messages of file readers.
#pragma once
#include <functional>
#include <string>

namespace clench {

using Listener = std::function<void(const std::string&)>;

/// Each may be empty.
struct Listeners {
  Listener warn = {};    ///< contents that are not used
  Listener note = {};    ///< missing values that are inferred
  Listener repair = {};  ///< invalid contents that are repaired; if empty, `warn` is called
  /// suspicious contents that are used unchanged; if empty, `warn` is called
  Listener suspect = {};
};

/// Calls the first, or otherwise the second, if there is one.
inline void tell(const Listener& first, const Listener& second, const std::string& sentence) {
  if (first)
    first(sentence);
  else if (second)
    second(sentence);
}

}  // namespace clench
