// The one exception of the engine: a sentence that says where, what was expected and what was got.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace clench {

/// Bad input. what() is one sentence: place, subject, expected, got.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& text) : std::runtime_error(without_zeros(text)) {}

 private:
  // what() would end at the first
  static std::string without_zeros(std::string text) {
    for (size_t at = 0; (at = text.find('\0', at)) != std::string::npos;)
      text.replace(at, 1, "\\0");
    return text;
  }
};

/// throws Error with a formatted sentence
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace clench
