// Splits large texts into words without copies. For small texts base/text.h has more convenient
// functions.
#pragma once
#include <string>
#include <string_view>

#include "clench/base/text.h"
#include "clench/base/watched.h"

namespace clench {

class WordReader {
 public:
  /// `file` is the name shown in errors; `text` has plain line ends and must outlive the reader. A
  /// '#' starts a comment up to the line end.   `joins_lines`: a '\' at the end of a line continues
  /// it on the next
  WordReader(std::string file, std::string_view text, bool joins_lines = false)
      : file_(std::move(file)), text_(text), joins_lines_(joins_lines) {}

  /// Moves to the next line that contains a word.   returns  false at the end of the text
  bool next_line();
  /// The next word of the line; "" at its end.
  std::string_view word();
  /// The rest of the line unchanged, including '#', with blanks trimmed.
  std::string_view rest();
  /// Number of words left on the line; does not move.
  int words_left() const;
  /// The next word on this or a later line; "" at the end of the text.
  std::string_view word_anywhere();

  int line() const { return line_; }  ///< from 1
  const std::string& file() const { return file_; }
  Place place() const { return Place(file_, line_ > 0 ? line_ : 1); }
  /// throws Error  "part.off:31: x: expected a number, got 'abc'"
  double number(std::string_view what);
  int integer(std::string_view what, int low, int high);
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw PlacedError(place(), fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  void skip_blanks();
  bool start_line();

  std::string file_;
  std::string_view text_;
  bool joins_lines_;
  size_t at_ = 0, end_ = 0;  // rest of the line
  size_t next_ = 0;          // start of the next line
  int line_ = 0;
  StopCheck check_{1 << 12};  // per word and line
};

}  // namespace clench
