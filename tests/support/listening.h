// A sink that passes messages to one function per kind.
#pragma once
#include <functional>
#include <string>

#include "clench/base/diagnostic.h"

namespace clench::test {

/// Each may be empty.
struct Listening {
  using Listener = std::function<void(const std::string&)>;
  Listener warn = {};
  Listener note = {};
  Listener repair = {};   ///< if empty, `warn` is called
  Listener suspect = {};  ///< if empty, `warn` is called

  operator Diagnostics() const {
    return Diagnostics([own = *this](const Diagnostic& d) {
      const Listener& listener = d.about == About::inferred                    ? own.note
                                 : d.about == About::repaired && own.repair    ? own.repair
                                 : d.about == About::suspicious && own.suspect ? own.suspect
                                                                               : own.warn;
      if (listener) listener(d.sentence());
    });
  }
};

}  // namespace clench::test
