#include "clench/io/text/json_tree.h"

#include <fmt/format.h>

#include <algorithm>

#include "clench/base/hex_digit.h"
#include "clench/base/text.h"

namespace clench {

namespace {

/// Reads values without recursion: the tree stores the open lists and maps.
class JsonReader {
 public:
  JsonReader(std::string_view text, ValueTree& out) : text_(text), out_(out) {}

  void read() {
    value();
    while (!open_.empty()) entry();
    skip_blanks();
    if (at_ < text_.size()) refuse("the end of the file");
  }

 private:
  [[noreturn]] void refuse(const std::string& expected) const {
    throw JsonFault{line_, fmt::format("expected {}, got {}", expected,
                                       at_ < text_.size() ? in_quotes(text_.substr(at_, 1))
                                                          : "the end of the file")};
  }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') ++line_;
      if (c != ' ' && c != '\t' && c != '\r' && c != '\n') return;
    }
  }

  void open(ValueKind kind) {
    ++at_;
    out_.open(kind, line_);
    open_ += kind == ValueKind::list ? ']' : '}';
    is_first_ = true;
  }

  // the next entry of the open list or map, or its end
  void entry() {
    skip_blanks();
    const char end = open_.back();
    if (take(end)) {
      open_.pop_back();
      out_.close();
      is_first_ = false;
      return;
    }
    if (!is_first_) {
      if (!take(',')) refuse(end == ']' ? "',' or ']'" : "',' or '}'");
      skip_blanks();
    }
    is_first_ = false;
    if (end == '}') {
      if (peek() != '"') refuse("a key in double quotes");
      string();
      skip_blanks();
      if (!take(':')) refuse("':'");
    }
    value();
  }

  void value() {
    skip_blanks();
    const char c = peek();
    if (c == '{') return open(ValueKind::map);
    if (c == '[') return open(ValueKind::list);
    if (c == '"') return string();
    if (c == '-' || (c >= '0' && c <= '9')) return number();
    for (const std::string_view word : {"true", "false", "null"})
      if (text_.substr(at_, word.size()) == word) {
        at_ += word.size();
        out_.scalar(word == "null" ? std::string_view() : word, false, line_);
        return;
      }
    refuse("a value");
  }

  void digits() {
    if (peek() < '0' || peek() > '9') refuse("a digit");
    while (peek() >= '0' && peek() <= '9') ++at_;
  }

  void number() {
    const size_t begin = at_;
    take('-');
    if (!take('0')) digits();
    if (take('.')) digits();
    if (take('e') || take('E')) {
      if (!take('+')) take('-');
      digits();
    }
    out_.scalar(text_.substr(begin, at_ - begin), false, line_);
  }

  unsigned hex4() {
    unsigned code = 0;
    for (int i = 0; i < 4; ++i) {
      const int digit = hex_digit(peek());
      if (digit < 0) refuse("a hexadecimal digit");
      code = code * 16 + static_cast<unsigned>(digit);
      ++at_;
    }
    return code;
  }

  void escape() {
    constexpr std::string_view marks = "\"\\/bfnrt", letters = "\"\\/\b\f\n\r\t";
    if (const size_t plain = marks.find(peek()); at_ < text_.size() && plain != marks.npos) {
      ++at_;
      scratch_ += letters[plain];
      return;
    }
    if (!take('u')) refuse("one of \" \\ / b f n r t u after a backslash");
    unsigned code = hex4();
    if (code >= 0xD800 && code < 0xDC00) {
      const unsigned low = take('\\') && take('u') ? hex4() : 0;
      if (low < 0xDC00 || low > 0xDFFF) refuse("the second half of a surrogate pair");
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    } else if (code >= 0xDC00 && code < 0xE000) {
      refuse("the first half of a surrogate pair before this one");
    }
    scratch_ += text_of(std::u32string(1, code));
  }

  void string() {
    ++at_;
    scratch_.clear();
    while (!take('"')) {
      if (at_ >= text_.size() || text_[at_] == '\n') refuse("the end of a string");
      if (take('\\')) {
        escape();
        continue;
      }
      const size_t end = std::min(text_.find_first_of("\"\\\n", at_ + 1), text_.size());
      scratch_ += text_.substr(at_, end - at_);
      at_ = end;
    }
    out_.scalar(scratch_, true, line_);
  }

  std::string_view text_;
  ValueTree& out_;
  std::string open_;  // brackets that close the open lists and maps
  bool is_first_ = false;
  size_t at_ = 0;
  int line_ = 1;
  std::string scratch_;
};

}  // namespace

std::optional<JsonFault> read_json_tree(std::string_view text, ValueTree& out) {
  try {
    JsonReader(text, out).read();
    out.finish();
    return {};
  } catch (const JsonFault& fault) {
    return fault;
  }
}

}  // namespace clench
