// The one exception of the engine: a sentence that says where, what was expected and what was got.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace clench {

/// What went wrong, for who wants to handle it.
enum class ErrorKind {
  input,    ///< an argument is not as it should be, or does not fit the world
  file,     ///< a file cannot be read or written, or does not hold what it should
  stale,    ///< what is meant is gone, or no longer as it was when it was measured
  limit,    ///< more than there is memory or time for
  internal  ///< a fault of ours: rounding broke a result, or a library failed
};

/// what() is one sentence: place, subject, expected, got.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& text, ErrorKind kind = ErrorKind::input)
      : std::runtime_error(without_zeros(text)), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
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

/// the same, of a kind
template <class... Args>
[[noreturn]] void fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...), kind);
}

}  // namespace clench
