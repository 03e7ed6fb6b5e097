// The one exception of the engine: a sentence that says where, what was wanted and what was got.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace clench {

/// Bad input. what() is one sentence: place, subject, wanted, got.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// throws Error with a formatted sentence
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace clench
