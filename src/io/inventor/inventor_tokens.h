// Splits the text of an Inventor or VRML file into words, strings and brackets, each with its line.
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
  size_t start = 0;  ///< offset in the text

  /// For messages: in quotes, or "the end of the file".
  std::string told() const;
  // strings have text, too, so kinds must be compared
  bool is(std::string_view what) const { return kind == word && text == what; }
  bool opens(char bracket) const { return kind == open && text[0] == bracket; }
};

class InventorTokens {
 public:
  /// Skips the header, which is on the first line or after comments. Both arguments must outlive
  /// this object; `file` is the name shown in errors.
  /// throws Error  "box.iv:1: expected a header such as ..."
  InventorTokens(std::string_view text, const std::string& file);

  bool vrml2() const { return vrml2_; }
  InventorToken next();
  InventorToken peek();
  /// The token after the next one.
  InventorToken peek_second();

  /// A part of the text, and the line on which it begins.
  struct Part {
    size_t start = 0, end = 0;
    int line = 0;
  };
  /// The rest of the text.
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
  StopCheck check_{1 << 12};  // per token
};

}  // namespace clench
