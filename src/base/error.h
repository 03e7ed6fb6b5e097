// The only exception type of the engine: a sentence with the place, the expected and the actual
// value.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace clench {

/// Kind of a failure, for error handlers.
enum class ErrorKind {
  input,    ///< an argument is invalid, or does not fit the world
  file,     ///< a file cannot be read or written, or has invalid contents
  stale,    ///< the named thing no longer exists, or has changed since it was measured
  limit,    ///< memory or time is insufficient
  internal  ///< an internal error: rounding broke a result, or a library failed
};

/// what() is one sentence: place, subject, expected, got.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& text, ErrorKind kind = ErrorKind::input)
      : std::runtime_error(without_zeros(text)), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
  // what() would end at the first NUL
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

/// the same, with a kind
template <class... Args>
[[noreturn]] void fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...), kind);
}

}  // namespace clench
