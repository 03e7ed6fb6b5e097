#include <charconv>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/hex_digit.h"
#include "clench/base/text.h"
#include "clench/script/lua/json.h"
#include "clench/script/lua/lua_budget.h"

namespace clench {

namespace {

class Reader {
 public:
  Reader(lua_State* L, std::string_view text, const char* name, size_t max_values)
      : L_(L), text_(text), name_(name), max_values_(max_values), budget_(L, name, text.size()) {}

  void read() {
    begin();
    value(0);
    end();
  }

  void split() {
    begin();
    lua_newtable(L_);
    const char closing = peek() == '[' ? ']' : '}';
    if (!take('[') && !take('{')) refuse("'[' or '{'");
    blanks();
    for (lua_Integer i = 1; !take(closing); ++i) {
      if (i > 1 && !take(',')) refuse(fmt::format("',' or '{}'", closing));
      count();
      if (closing == '}') name();
      push(skip());
      if (closing == '}')
        lua_rawset(L_, -3);
      else
        lua_rawseti(L_, -2, i);
    }
    end();
  }

 private:
  [[noreturn]] void complain(size_t at, const std::string& what) const {
    size_t line = 1, column = 1;
    for (size_t i = 0; i < at; ++i) {
      ++column;
      if (text_[i] == '\n') ++line, column = 1;
    }
    fail("{}: line {}, column {}: {}", name_, line, column, what);
  }

  [[noreturn]] void refuse(const std::string& expected) const {
    if (at_ >= text_.size()) complain(at_, "expected " + expected + ", got the end of the text");
    const auto c = static_cast<unsigned char>(text_[at_]);
    const auto got =
        c >= 32 && c < 127 ? fmt::format("'{}'", text_[at_]) : fmt::format("byte {}", c);
    complain(at_, "expected " + expected + ", got " + got);
  }

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(char c) { return peek() == c && at_ < text_.size() ? ++at_, true : false; }
  void blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  bool word(std::string_view name) {
    if (!text_.substr(at_).starts_with(name)) return false;
    at_ += name.size();
    return true;
  }

  void begin() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    blanks();
  }

  void end() {
    blanks();
    if (at_ < text_.size()) refuse("the end");
  }

  void push(std::string_view text) { lua_pushlstring(L_, text.data(), text.size()); }

  void count() {
    budget_.check();
    if (++values_ > max_values_)
      fail(ErrorKind::limit, "{}: expected at most {} values", name_, max_values_);
  }

  void value(int depth) {
    count();
    if (depth > json_depth) complain(at_, fmt::format("nested deeper than {} levels", json_depth));
    if (!lua_checkstack(L_, 8)) complain(at_, "too many values on Lua's stack");
    blanks();
    const char c = peek();
    if (c == '{') return object(depth);
    if (c == '[') return list(depth);
    if (c == '"') {
      push(string());
    } else if (c == '-' || (c >= '0' && c <= '9')) {
      number();
    } else if (word("true") || word("false")) {
      lua_pushboolean(L_, text_[at_ - 2] == 'u');
    } else if (word("null")) {
      push_json_null(L_);
    } else {
      refuse("a value");
    }
  }

  void list(int depth) {
    ++at_;
    lua_newtable(L_);
    blanks();
    if (take(']')) return;
    for (lua_Integer i = 1;; ++i) {
      value(depth + 1);
      lua_rawseti(L_, -2, i);
      blanks();
      if (take(']')) return;
      if (!take(',')) refuse("',' or ']'");
    }
  }

  void object(int depth) {
    ++at_;
    lua_newtable(L_);
    blanks();
    if (take('}')) return mark_json_object(L_);
    for (;;) {
      name();
      if (word("null")) {
        count();
        lua_pushnil(L_);
      } else {
        value(depth + 1);
      }
      lua_rawset(L_, -3);
      blanks();
      if (take('}')) break;
      if (!take(',')) refuse("',' or '}'");
    }
    lua_pushnil(L_);
    if (!lua_next(L_, -2)) return mark_json_object(L_);
    lua_pop(L_, 2);
  }

  // the name of a field, and the colon after it
  void name() {
    blanks();
    if (peek() != '"') refuse("a name in double quotes");
    push(string());
    blanks();
    if (!take(':')) refuse("':'");
    blanks();
  }

  // the text of a value, without blanks around it
  std::string_view skip() {
    blanks();
    const size_t start = at_;
    size_t end = at_, depth = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        skip_string();
      } else if (c == '[' || c == '{') {
        ++depth;
      } else if (depth == 0 && (c == ',' || c == ']' || c == '}')) {
        break;
      } else if (c == ']' || c == '}') {
        --depth;
      }
      if (!is_blank(c)) end = at_ + 1;
    }
    if (end == start) refuse("a value");
    return text_.substr(start, end - start);
  }

  // from its opening to its closing quote
  void skip_string() {
    const size_t start = at_++;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    if (at_ >= text_.size()) complain(start, "a string that never ends");
  }

  bool digits() {
    const size_t start = at_;
    while (peek() >= '0' && peek() <= '9') ++at_;
    return at_ > start;
  }

  void number() {
    const size_t start = at_;
    const bool negative = take('-');
    if (!take('0') && !digits()) refuse("a digit");
    if (peek() >= '0' && peek() <= '9') complain(at_, "expected a number without leading zeros");
    bool whole = true;
    if (take('.')) {
      whole = false;
      if (!digits()) refuse("a digit");
    }
    if (peek() == 'e' || peek() == 'E') {
      ++at_, whole = false;
      if (!take('+')) take('-');
      if (!digits()) refuse("a digit");
    }
    const char *first = text_.data() + start, *last = text_.data() + at_;
    lua_Integer n = 0;
    if (whole && std::from_chars(first, last, n).ec == std::errc() && !(negative && n == 0))
      return lua_pushinteger(L_, n);
    double x = 0;
    const auto result = std::from_chars(first, last, x);
    // out of range means either overflow, an error, or underflow, which gives zero or a tiny number
    if (result.ec != std::errc()) x = std::strtod(std::string(first, last).c_str(), nullptr);
    if (!std::isfinite(x))
      complain(start, "a number too large for 64 bits: " +
                          std::string(std::string_view(first, last).substr(0, 40)));
    lua_pushnumber(L_, x);
  }

  unsigned hex4() {
    unsigned code = 0;
    for (int i = 0; i < 4; ++i, ++at_) {
      const int digit = hex_digit(peek());
      if (digit < 0) refuse("a hexadecimal digit");
      code = code * 16 + static_cast<unsigned>(digit);
    }
    return code;
  }

  void escape() {
    const size_t start = at_ - 1;
    const char c = peek();
    const size_t plain = std::string_view("\"\\/bfnrt").find(c);
    if (at_ < text_.size() && plain != std::string_view::npos) {
      ++at_;
      scratch_ += "\"\\/\b\f\n\r\t"[plain];
      return;
    }
    if (!take('u')) refuse("one of \" \\ / b f n r t u after a backslash");
    unsigned code = hex4();
    if (code >= 0xD800 && code < 0xDC00) {
      // the first half of a surrogate pair
      const unsigned low = take('\\') && take('u') ? hex4() : 0;
      if (low < 0xDC00 || low > 0xDFFF) complain(start, "half of a surrogate pair");
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    } else if (code >= 0xDC00 && code < 0xE000) {
      complain(start, "half of a surrogate pair");
    }
    scratch_ += text_of(std::u32string(1, code));
  }

  // begins at the opening quote; valid until the next call
  const std::string& string() {
    const size_t start = at_++;
    scratch_.clear();
    while (at_ < text_.size() && text_[at_] != '"') {
      const char c = text_[at_++];
      if (c == '\\') {
        escape();
      } else if (static_cast<unsigned char>(c) < 0x20) {
        --at_;
        refuse("no control character in a string");
      } else {
        scratch_ += c;
      }
    }
    if (!take('"')) complain(start, "a string that never ends");
    return scratch_;
  }

  lua_State* L_;
  std::string_view text_;
  const char* name_;  ///< of the function, for messages
  size_t at_ = 0, values_ = 0, max_values_;
  std::string scratch_;
  LuaBudget budget_;
};

}  // namespace

void read_json(lua_State* L, std::string_view text, size_t max_values) {
  Reader(L, text, "clench.json.decode", max_values).read();
}

void split_json(lua_State* L, std::string_view text, size_t max_values) {
  Reader(L, text, "clench.json.split", max_values).split();
}

}  // namespace clench
