// The classes that robot files name: they mean nothing to us, but a word that is none is a mistake.
#pragma once
#include <functional>
#include <string>

namespace clench {

/// Tells `warn` of a name that no class has. `place` begins the sentence:
/// "hand.cfg:1: robot: unknown type 'Hnad' has no meaning; did you mean 'Hand'?"
void check_class(const std::string& name, const std::string& place,
                 const std::function<void(const std::string&)>& warn);

}  // namespace clench
