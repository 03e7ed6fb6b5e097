// Who is told of decisions that a file, or a description from one, leaves to us.
#pragma once
#include <functional>
#include <string>

namespace clench {

using Listener = std::function<void(const std::string&)>;

/// Each may be empty.
struct Listeners {
  Listener warn = {};    ///< of what it contains and we do not use
  Listener note = {};    ///< of what it leaves open and we guess
  Listener repair = {};  ///< of what it has wrong and we put right; when empty, `warn` is told
  /// of what is used as it stands, and looks wrong; when empty, `warn` is told
  Listener suspect = {};
};

/// Tells the first, or else the second, if there is one.
inline void tell(const Listener& first, const Listener& second, const std::string& sentence) {
  if (first)
    first(sentence);
  else if (second)
    second(sentence);
}

}  // namespace clench
