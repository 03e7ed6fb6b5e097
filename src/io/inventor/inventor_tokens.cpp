#include "clench/io/inventor/inventor_tokens.h"

#include <algorithm>
#include <array>

#include "clench/base/text.h"

namespace clench {

namespace {

constexpr std::string_view inventor_headers[] = {"#Inventor V2.1 ascii", "#Inventor V2.0 ascii",
                                                 "#Inventor V1.0 ascii", "#VRML V1.0 ascii",
                                                 "#VRML V2.0 utf8"};

constexpr std::array<bool, 256> ends_word = [] {
  std::array<bool, 256> out{};
  for (const unsigned char c : std::string_view(" \t\n\v\f,{}[]\"#\0", 13)) out[c] = true;
  return out;
}();

}  // namespace

std::string InventorToken::told() const {
  return kind == end ? "the end of the file" : in_quotes(text);
}

InventorTokens::InventorTokens(std::string_view text, const std::string& file)
    : text_(without_mark(text)), file_(file), end_(text_.size()) {
  std::string_view first;
  while (at_ < end_) {
    const size_t line_end = std::min(text_.find('\n', at_), end_);
    const std::string_view line = trim(text_.substr(at_, line_end - at_));
    if (first.empty()) first = line;
    if (line.starts_with("#Inventor") && line.find("binary") != std::string_view::npos)
      refuse(line_, "binary Inventor files are not read; expected '#Inventor V2.1 ascii'");
    for (const auto header : inventor_headers)
      if (line.starts_with(header)) {
        vrml2_ = header == "#VRML V2.0 utf8";
        at_ = line_end;
        return;
      }
    if (!line.empty() && line.front() != '#') break;
    ++line_;
    at_ = std::min(line_end + 1, end_);
  }
  refuse(1, "expected a header such as '#Inventor V2.1 ascii' or '#VRML V2.0 utf8', got {}",
         in_quotes(first));
}

/// White space, commas and comments.
void InventorTokens::skip_blanks() {
  for (; at_ < end_; ++at_) {
    const char c = text_[at_];
    if (c == '#') at_ = std::min(text_.find('\n', at_), end_);
    if (at_ < end_ && text_[at_] == '\n')
      ++line_;
    else if (c != '#' && c != ' ' && c != '\t' && c != ',' && c != '\v' && c != '\f')
      break;
  }
  at_ = std::min(at_, end_);
}

InventorToken InventorTokens::next() {
  check_();
  skip_blanks();
  InventorToken token{InventorToken::end, {}, line_, at_};
  if (at_ >= end_) return token;
  const char c = text_[at_];
  if (c == '\0')
    refuse(line_, "expected text, got a byte of value 0; binary Inventor files are not read");
  if (c == '{' || c == '[' || c == '}' || c == ']') {
    token.kind = c == '{' || c == '[' ? InventorToken::open : InventorToken::close;
    token.text = text_.substr(at_++, 1);
  } else if (c == '"') {
    token.kind = InventorToken::string;
    for (++at_; at_ < end_ && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < end_) ++at_;
      if (text_[at_] == '\n') ++line_;
    }
    if (at_ >= end_) refuse(token.line, "a string has no closing quote");
    token.text = text_.substr(token.start + 1, at_++ - token.start - 1);
  } else {
    token.kind = InventorToken::word;
    while (at_ < end_ && !ends_word[static_cast<unsigned char>(text_[at_])]) ++at_;
    token.text = text_.substr(token.start, at_ - token.start);
  }
  return token;
}

InventorToken InventorTokens::peek() {
  const Part here = rest();
  const InventorToken token = next();
  read_only(here);
  return token;
}

InventorToken InventorTokens::peek_second() {
  const Part here = rest();
  next();
  const InventorToken token = next();
  read_only(here);
  return token;
}

}  // namespace clench
