#include "clench/io/text/word_reader.h"

#include <algorithm>

namespace clench {

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

bool WordReader::start_line() {
  check_();
  if (next_ >= text_.size()) {
    at_ = end_ = text_.size();
    return false;
  }
  at_ = next_;
  end_ = std::min(text_.find('\n', at_), text_.size());
  next_ = end_ + 1;
  ++line_;
  return true;
}

void WordReader::skip_blanks() {
  while (at_ < end_ && is_blank(text_[at_])) ++at_;
}

bool WordReader::next_line() {
  while (start_line()) {
    skip_blanks();
    if (at_ < end_ && text_[at_] != '#') return true;
  }
  return false;
}

std::string_view WordReader::word() {
  check_();
  for (;;) {
    skip_blanks();
    if (at_ >= end_ || text_[at_] == '#') return {};
    const size_t first = at_;
    while (at_ < end_ && !is_blank(text_[at_])) ++at_;
    auto word = text_.substr(first, at_ - first);
    if (!joins_lines_ || word.back() != '\\' || !trim(text_.substr(at_, end_ - at_)).empty())
      return word;
    word.remove_suffix(1);
    start_line();
    if (!word.empty()) return word;
  }
}

std::string_view WordReader::rest() {
  const auto text = trim(text_.substr(at_, end_ - at_));
  at_ = end_;
  return text;
}

int WordReader::words_left() const {
  int count = 0;
  for (size_t i = at_; i < end_ && text_[i] != '#';) {
    if (is_blank(text_[i])) {
      ++i;
      continue;
    }
    ++count;
    while (i < end_ && !is_blank(text_[i])) ++i;
  }
  return count;
}

std::string_view WordReader::word_anywhere() {
  for (;;) {
    if (const auto found = word(); !found.empty()) return found;
    if (!next_line()) return {};
  }
}

double WordReader::number(std::string_view what) {
  const auto text = word();
  const auto value = parse_number(text);
  if (!value) fail("{}: expected a number, got {}", what, in_quotes(text));
  return *value;
}

int WordReader::integer(std::string_view what, int low, int high) {
  const auto text = word();
  if (const auto fault = integer_fault(text, low, high); !fault.empty())
    fail("{}: {}", what, fault);
  return *parse_integer(text);
}

}  // namespace clench
