// The text of an Inventor or VRML file as words, strings and brackets, each with its line.
#pragma once
#include <string>
#include <string_view>

#include "clench/base/error.h"
#include "clench/base/watched.h"

namespace clench {

struct InventorToken {
  enum Kind { word, string, open, close, end } kind = end;
  std::string_view text;  ///< without the quotes of a string
  int line = 0;
  size_t start = 0;  ///< where it stands in the text

  /// For a sentence: in quotes, "the end of the file".
  std::string told() const;
  // strings have text, too, which is neither word nor bracket
  bool is(std::string_view what) const { return kind == word && text == what; }
  bool opens(char bracket) const { return kind == open && text[0] == bracket; }
};

class InventorTokens {
 public:
  /// Reads over the header, which stands on the first line or after comments. Both arguments
  /// must live on; `file` is the name shown in errors.
  /// throws Error  "box.iv:1: expected a header such as ..."
  InventorTokens(std::string_view text, const std::string& file);

  bool vrml2() const { return vrml2_; }
  InventorToken next();
  InventorToken peek();
  /// The one behind the next one.
  InventorToken peek_second();

  /// A part of the text, and where it begins in the file.
  struct Part {
    size_t start = 0, end = 0;
    int line = 0;
  };
  /// What is left.
  Part rest() const { return {at_, end_, line_}; }
  void read_only(const Part& part) { at_ = part.start, end_ = part.end, line_ = part.line; }

  template <class... Args>
  [[noreturn]] void refuse(int line, fmt::format_string<Args...> format, Args&&... args) const {
    throw Error(fmt::format("{}:{}: ", file_, line) +
                fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  void skip_blanks();

  std::string_view text_;
  const std::string& file_;
  size_t at_ = 0, end_;
  int line_ = 1;
  bool vrml2_ = false;
  StopCheck check_{1 << 12};  // of tokens
};

}  // namespace clench
