#include "clench/base/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "clench/base/file.h"
#include "clench/base/printable.h"

namespace clench {

static bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

std::string plain_text(std::string raw) {
  raw.erase(0, raw.size() - without_mark(raw).size());
  // in place: text between two carriage returns is moved as one block
  size_t from = raw.find('\r');
  if (from == std::string::npos) return raw;
  size_t to = from;
  while (from < raw.size()) {
    // one before a line feed is removed, another becomes a line feed
    if (++from == raw.size() || raw[from] != '\n') raw[to++] = '\n';
    const size_t next = std::min(raw.find('\r', from), raw.size());
    std::copy(raw.begin() + static_cast<std::ptrdiff_t>(from),
              raw.begin() + static_cast<std::ptrdiff_t>(next),
              raw.begin() + static_cast<std::ptrdiff_t>(to));
    to += next - from;
    from = next;
  }
  raw.resize(to);
  return raw;
}

std::string read_text(const std::filesystem::path& path) {
  constexpr uintmax_t most = uintmax_t{256} << 20;
  std::error_code code;
  const auto size = std::filesystem::file_size(path, code);
  if (!code && size > most)
    fail("{}: expected a text file of at most 256 MB, got {} bytes", path.generic_string(), size);
  return plain_text(read_bytes(path));
}

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return {};
  }
  // only digits: this excludes inf, nan and hexadecimal
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string_view::npos)
    return {};
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return {};
  if (code == std::errc::result_out_of_range) {
    // underflow gives zero, overflow is rejected
    const size_t e = text.find_first_of("eE");
    if (e != std::string_view::npos && text.substr(e + 1).starts_with('-')) return 0.0;
    return {};
  }
  if (code != std::errc() || !std::isfinite(value)) return {};
  return value;
}

std::optional<int> parse_integer(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  int value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

std::string integer_fault(std::string_view word, int low, int high) {
  const size_t sign = !word.empty() && (word[0] == '+' || word[0] == '-');
  const bool whole =
      word.size() > sign && word.find_first_not_of("0123456789", sign) == std::string_view::npos;
  if (!whole) return "expected a whole number, got " + in_quotes(word);
  const auto value = parse_integer(word);
  if (value && *value >= low && *value <= high) return "";
  const std::string got = value ? fmt::format("{}", *value) : in_quotes(word);
  const bool below = value ? *value < low : word[0] == '-';
  if (below && high == std::numeric_limits<int>::max() && low > std::numeric_limits<int>::min())
    return fmt::format("expected a whole number from {} on, got {}", low, got);
  return fmt::format("expected a whole number from {} to {}, got {}", low, high, got);
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

// the first word at or after `at`; empty if there is none
static std::string_view word_from(std::string_view text, size_t at, std::string_view separators) {
  const auto parts = [&](char c) {
    return is_blank(c) || separators.find(c) != std::string_view::npos;
  };
  while (at < text.size() && parts(text[at])) ++at;
  size_t end = at;
  while (end < text.size() && !parts(text[end])) ++end;
  return text.substr(at, end - at);
}

// the word after a word of the text, or the first one after an empty word
static std::string_view word_behind(std::string_view text, std::string_view word,
                                    std::string_view separators = "") {
  const size_t at = word.empty() ? 0 : word.data() + word.size() - text.data();
  return word_from(text, at, separators);
}

std::vector<std::string_view> split_words(std::string_view text, std::string_view separators,
                                          size_t most) {
  std::vector<std::string_view> words;
  auto word = word_behind(text, "", separators);
  for (; !word.empty() && words.size() < most; word = word_behind(text, word, separators))
    words.push_back(word);
  return words;
}

size_t utf8_size(std::string_view text, size_t i) {
  const auto byte = [&](size_t k) {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const size_t size = first >= 0xC2 && first < 0xE0   ? 2
                      : first >= 0xE0 && first < 0xF0 ? 3
                      : first >= 0xF0 && first < 0xF5 ? 4
                                                      : 0;
  for (size_t k = 1; k < size; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  // overlong encoding, a surrogate, or beyond the last code point
  if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F)) return 0;
  if ((first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F)) return 0;
  return size;
}

std::u32string letters_of(std::string_view text, bool or_latin1) {
  std::u32string out;
  for (size_t i = 0; i < text.size();) {
    const size_t size = utf8_size(text, i);
    const auto first = static_cast<unsigned char>(text[i]);
    char32_t letter = size > 1 ? first & (0x7F >> size) : size == 1 || or_latin1 ? first : 0xFFFD;
    for (size_t k = 1; k < size; ++k) letter = letter << 6 | (text[i + k] & 0x3F);
    out += letter;
    i += std::max<size_t>(size, 1);
  }
  return out;
}

std::string text_of(std::u32string_view letters) {
  std::string out;
  for (const char32_t letter : letters) {
    const int more = letter < 0x80 ? 0 : letter < 0x800 ? 1 : letter < 0x10000 ? 2 : 3;
    constexpr unsigned first[] = {0, 0xC0, 0xE0, 0xF0};
    out += static_cast<char>(first[more] | letter >> 6 * more);
    for (int i = more - 1; i >= 0; --i) out += static_cast<char>(0x80 | (letter >> 6 * i & 0x3F));
  }
  return out;
}

std::string excerpt(std::string_view text) {
  const std::string out = printable(text.substr(0, max_excerpt));
  return text.size() > max_excerpt ? out + "..." : out;
}

std::string in_quotes(std::string_view text) {
  return text.empty() ? "nothing" : fmt::format("'{}'", excerpt(text));
}

Line::Line(const std::string* file, int number, std::string_view text)
    : file_(file), number_(number), text_(trim(text)) {}

Place Line::place() const { return Place(file_ ? *file_ : "", number_); }

std::string_view Line::word(int i) const {
  if (i < last_ || last_ < 0) last_ = 0, last_word_ = word_behind(text_, "");
  for (; last_ < i && !last_word_.empty(); ++last_) last_word_ = word_behind(text_, last_word_);
  return last_word_;
}

int Line::size() const {
  if (size_ >= 0) return size_;
  size_ = 0;
  for (auto w = word_behind(text_, ""); !w.empty(); w = word_behind(text_, w)) ++size_;
  return size_;
}

Line Line::before(char mark) const {
  for (auto w = word_behind(text_, ""); !w.empty(); w = word_behind(text_, w))
    if (w.front() == mark) return Line(file_, number_, text_.substr(0, w.data() - text_.data()));
  return *this;
}

std::string Line::surplus(int used) const {
  const int more = before('#').size() - used;
  if (more <= 0) return "";
  return more == 1 ? "1 surplus word is not used"
                   : fmt::format("{} surplus words are not used", more);
}

double Line::number(int i, std::string_view what) const {
  const auto value = parse_number(word(i));
  if (!value) fail("{}: expected a number, got {}", what, in_quotes(word(i)));
  return *value;
}

int Line::integer(int i, std::string_view what, int low, int high) const {
  if (const auto fault = integer_fault(word(i), low, high); !fault.empty())
    fail("{}: {}", what, fault);
  return *parse_integer(word(i));
}

LineReader::LineReader(std::string file, std::string text)
    : file_(std::move(file)), text_(std::move(text)) {}

std::string_view LineReader::line() const {
  const std::string_view rest = std::string_view(text_).substr(at_);
  return rest.substr(0, rest.find('\n'));
}

void LineReader::step() {
  at_ = std::min(at_ + line().size() + 1, text_.size());
  ++passed_;
}

Line LineReader::peek() const {
  if (done()) return Line(&file_, std::max(1, passed_), "");
  return Line(&file_, passed_ + 1, line());
}

Line LineReader::next() {
  const Line line = peek();
  if (!done()) step();
  return line;
}

bool LineReader::skip_to(char mark) {
  const size_t found = text_.find(mark, at_);
  if (found == std::string::npos) {
    passed_ += static_cast<int>(
        std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.end(), '\n'));
    passed_ += !done() && text_.back() != '\n';  // the last line may have no line end
    at_ = text_.size();
    return false;
  }
  const size_t before = found == 0 ? std::string::npos : text_.rfind('\n', found - 1);
  const size_t begin = before == std::string::npos ? 0 : before + 1;
  if (begin > at_) {
    passed_ +=
        static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                    text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    at_ = begin;
  }
  return true;
}

bool LineReader::skip_to_full() {
  while (!done()) {
    const auto text = trim(line());
    if (!text.empty() && text.front() != '#') return true;
    step();
  }
  return false;
}

Line LineReader::next_full(std::string_view what) {
  if (!skip_to_full()) peek().fail("expected {}, got the end of the file", what);
  return next();
}

}  // namespace clench
