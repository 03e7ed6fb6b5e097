#include "clench/io/text/yaml.h"

#include <algorithm>

#include "clench/base/text.h"

namespace clench {

static constexpr int max_depth = 16;

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[size_t(found - keys.begin())];
}

std::string YamlNode::described() const {
  if (kind == Kind::list) return fmt::format("a list of {}", items.size());
  return kind == Kind::map ? "a map" : in_quotes(text);
}

static void append_utf8(std::string& out, unsigned code) {
  if (code < 0x80) {
    out += char(code);
  } else if (code < 0x800) {
    out += {char(0xC0 | (code >> 6)), char(0x80 | (code & 63))};
  } else if (code < 0x10000) {
    out += {char(0xE0 | (code >> 12)), char(0x80 | ((code >> 6) & 63)), char(0x80 | (code & 63))};
  } else {
    out += {char(0xF0 | (code >> 18)), char(0x80 | ((code >> 12) & 63)),
            char(0x80 | ((code >> 6) & 63)), char(0x80 | (code & 63))};
  }
}

namespace {

class YamlParser {
 public:
  YamlParser(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  YamlNode document() {
    skip();
    if (text_.substr(at_, 3) == "---" && column() == 0) at_ += 3;
    skip();
    if (at_ == text_.size()) fail("{}: expected a map or a list, got an empty file", file_);
    YamlNode out = block(0);
    skip();
    if (at_ < text_.size()) refuse("the end of the file");
    return out;
  }

 private:
  template <class... Args>
  [[noreturn]] void fail_here(fmt::format_string<Args...> format, Args&&... args) const {
    fail("{}:{}: {}", file_, line_, fmt::format(format, std::forward<Args>(args)...));
  }
  [[noreturn]] void refuse(const std::string& expected) const {
    const std::string_view rest = text_.substr(at_, text_.find('\n', at_) - at_);
    fail_here("expected {}, got {}", expected, at_ == text_.size() ? "the end of the file" : in_quotes(rest));
  }

  char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  int column() const { return int(at_ - start_); }
  bool ends_word(size_t ahead) const {
    const char c = peek(ahead);
    return at_ + ahead >= text_.size() || c == ' ' || c == '\n' || c == '\t';
  }
  // blanks, comments and ends of lines
  void skip() {
    while (at_ < text_.size()) {
      if (peek() == '\n') {
        ++at_;
        ++line_;
        start_ = at_;
      } else if (peek() == ' ' || peek() == '\t') {
        ++at_;
      } else if (peek() == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else {
        break;
      }
    }
  }
  void skip_blanks() {
    while (peek() == ' ' || peek() == '\t') ++at_;
    if (peek() == '#') at_ = std::min(text_.find('\n', at_), text_.size());
  }
  void enter(int depth) const {
    if (depth > max_depth) fail_here("expected lists and maps at most {} deep, got more", max_depth);
  }

  YamlNode quoted() {
    YamlNode out{.quoted = true, .line = line_};
    const char mark = text_[at_++];
    while (true) {
      if (at_ >= text_.size() || peek() == '\n') fail_here("expected the closing quote of {}", in_quotes(out.text));
      const char c = text_[at_++];
      if (c == mark && mark == '\'' && peek() == '\'') {
        out.text += text_[at_++];
      } else if (c == mark) {
        return out;
      } else if (c == '\\' && mark == '"') {
        escape(out.text);
      } else {
        out.text += c;
      }
    }
  }
  unsigned hex(int digits) {
    unsigned code = 0;
    for (int i = 0; i < digits; ++i) {
      const char c = char(std::tolower(static_cast<unsigned char>(peek())));
      if (!std::isxdigit(static_cast<unsigned char>(c))) refuse(fmt::format("{} hexadecimal digits", digits));
      code = code * 16 + unsigned(c <= '9' ? c - '0' : c - 'a' + 10);
      ++at_;
    }
    return code;
  }
  void escape(std::string& out) {
    static constexpr std::string_view marks = "nrtbf0\"\\/", values{"\n\r\t\b\f\0\"\\/", 9};
    const char c = peek();
    if (c == 'u') {
      ++at_;
      unsigned code = hex(4);
      if (code >= 0xD800 && code < 0xDC00 && peek() == '\\' && peek(1) == 'u') {
        at_ += 2;
        code = 0x10000 + ((code - 0xD800) << 10) + ((hex(4) - 0xDC00) & 0x3FF);
      }
      return append_utf8(out, code);
    }
    const size_t which = c == '\0' ? std::string_view::npos : marks.find(c);
    if (which == std::string_view::npos) refuse("an escape such as \\n or \\u00e9");
    out += values[which];
    ++at_;
  }

  // up to what ends it: ": ", " #", the end of the line; in brackets , ] } as well
  YamlNode plain(bool in_brackets) {
    if (std::string_view("&*!|>%@`").find(peek()) != std::string_view::npos && at_ < text_.size())
      refuse("a plain value, for anchors, tags and text over several lines are not read");
    YamlNode out{.line = line_};
    const size_t from = at_;
    while (at_ < text_.size() && peek() != '\n') {
      if (peek() == ':' && (ends_word(1) || (in_brackets && std::string_view(",]}").find(peek(1)) != std::string_view::npos))) break;
      if (peek() == '#' && at_ > from && (text_[at_ - 1] == ' ' || text_[at_ - 1] == '\t')) break;
      if (in_brackets && std::string_view(",[]{}").find(peek()) != std::string_view::npos) break;
      ++at_;
    }
    out.text = trim(text_.substr(from, at_ - from));
    return out;
  }
  YamlNode scalar(bool in_brackets) {
    return peek() == '"' || peek() == '\'' ? quoted() : plain(in_brackets);
  }

  void add(YamlNode& map, YamlNode key, YamlNode value) {
    // long maps are lists of grasps: names are compared only where they are few
    if (map.keys.size() < 1000 && map.find(key.text))
      fail("{}:{}: key {} stands there twice", file_, key.line, in_quotes(key.text));
    map.keys.push_back(std::move(key.text));
    map.items.push_back(std::move(value));
  }

  YamlNode flow(int depth) {
    enter(depth);
    if (peek() != '[' && peek() != '{') return scalar(true);
    const bool is_map = peek() == '{';
    const char end = is_map ? '}' : ']';
    YamlNode out{.kind = is_map ? YamlNode::Kind::map : YamlNode::Kind::list, .line = line_};
    ++at_;
    while (true) {
      skip();
      if (peek() == end) break;
      if (at_ == text_.size()) refuse(fmt::format("'{}'", end));
      if (is_map) {
        YamlNode key = scalar(true);
        skip();
        if (peek() != ':') refuse("':' behind a key");
        ++at_;
        skip();
        add(out, std::move(key), flow(depth + 1));
      } else {
        const size_t before = at_;
        out.items.push_back(flow(depth + 1));
        if (at_ == before) refuse("a value");
      }
      skip();
      if (peek() == ',') {
        ++at_;
      } else if (peek() != end) {
        refuse(fmt::format("',' or '{}'", end));
      }
    }
    ++at_;
    return out;
  }

  bool is_item() const { return peek() == '-' && ends_word(1); }

  // what begins here, at the column of its lines
  YamlNode block(int depth) {
    enter(depth);
    const int indent = column();
    if (is_item()) return block_list(indent, depth);
    if (peek() == '[' || peek() == '{') return flow(depth);
    YamlNode first = scalar(false);
    skip_blanks();
    if (peek() != ':') return first;
    return block_map(std::move(first), indent, depth);
  }
  YamlNode block_list(int indent, int depth) {
    YamlNode out{.kind = YamlNode::Kind::list, .line = line_};
    while (at_ < text_.size() && column() == indent && is_item()) {
      ++at_;
      out.items.push_back(value(indent, depth, false));
      skip();
    }
    check_indent(indent);
    return out;
  }
  YamlNode block_map(YamlNode key, int indent, int depth) {
    YamlNode out{.kind = YamlNode::Kind::map, .line = key.line};
    while (true) {
      skip_blanks();
      if (peek() != ':') refuse("':' behind a key");
      ++at_;
      add(out, std::move(key), value(indent, depth, true));
      skip();
      if (at_ == text_.size() || column() != indent || is_item()) break;
      key = scalar(false);
    }
    check_indent(indent);
    return out;
  }
  void check_indent(int indent) const {
    if (at_ < text_.size() && column() > indent) refuse("a line that begins where those before it do");
  }
  // behind "-" or "key:": on the same line, or deeper on the next ones; a list may stand below its key
  YamlNode value(int indent, int depth, bool behind_key) {
    const int line = line_;
    skip_blanks();
    if (at_ < text_.size() && peek() != '\n') {
      YamlNode out = !behind_key ? block(depth + 1)
                     : peek() == '[' || peek() == '{' ? flow(depth + 1)
                                                      : scalar(false);
      skip_blanks();
      if (behind_key && at_ < text_.size() && peek() != '\n') refuse("the end of the line");
      return out;
    }
    skip();
    const bool deeper = column() > indent || (behind_key && column() == indent && is_item());
    if (at_ == text_.size() || !deeper) return YamlNode{.line = line};
    return block(depth + 1);
  }

  const std::string& file_;
  std::string_view text_;
  size_t at_ = 0, start_ = 0;  // start of the line
  int line_ = 1;
};

}  // namespace

YamlNode parse_yaml(const std::string& file, std::string_view text) {
  return YamlParser(file, text).document();
}

std::string yaml_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", int(c));
    else
      out += c;
  }
  return out + '"';
}

}  // namespace clench
