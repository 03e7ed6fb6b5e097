// Text files taken apart: lines, words, and numbers that are numbers. Whatever is wrong is told
// with the place "file:line", what was expected and what was got.
#pragma once
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clench/base/placed_error.h"

namespace clench {

/// Without the mark that some editors put before UTF-8.
std::string_view without_mark(std::string_view text);
/// Without such a mark; line ends of every kind become '\n'.
std::string plain_text(std::string raw);
/// A whole file as plain text.   throws as read_bytes, and when it is larger than 256 MB
std::string read_text(const std::filesystem::path& path);

/// A finite decimal number, an explicit '+' allowed, nothing before or after it; else empty.
std::optional<double> parse_number(std::string_view text);
std::optional<int> parse_integer(std::string_view text);
/// Why a word is no whole number from `low` to `high`: "expected a whole number from 1 to 9, got
/// 12"; empty when it is one.
std::string integer_fault(std::string_view word, int low, int high);

std::string_view trim(std::string_view text);
std::string lower_case(std::string_view text);
/// Words between white space and any of `separators`: the first `most`.
std::vector<std::string_view> split_words(std::string_view text, std::string_view separators = "",
                                          size_t most = std::string_view::npos);
/// Bytes of the character that begins at i; 0 when it is not UTF-8.
size_t utf8_size(std::string_view text, size_t i);
/// The characters of text in UTF-8; each byte that belongs to none is U+FFFD, or what it is in
/// Latin-1.
std::u32string letters_of(std::string_view text, bool or_latin1 = false);
/// Characters as UTF-8.
std::string text_of(std::u32string_view letters);
/// What messages show of a file: at most so many characters of any one place.
constexpr size_t max_excerpt = 120;
/// A word for a message: cut when long, unprintable characters as '?'.
std::string excerpt(std::string_view text);
/// The same in quotes; "nothing" when empty.
std::string in_quotes(std::string_view text);
/// Names or numbers for a message: "a, b, c"; after 300 characters "and 40 more".
template <class Names>
std::string name_list(const Names& names) {
  constexpr size_t longest = 300, longest_name = 120;
  std::string out;
  size_t left = std::size(names);
  for (const auto& name : names) {
    std::string text = fmt::format("{}", name);
    if (text.size() > longest_name) text.replace(longest_name - 3, std::string::npos, "...");
    if (!out.empty() && out.size() + text.size() + 2 > longest)
      return out + fmt::format(" and {} more", left);
    out += (out.empty() ? "" : ", ") + text;
    --left;
  }
  return out;
}

/// A line and where it stands. The text belongs to the LineReader that gave it.
class Line {
 public:
  Line() = default;
  Line(const std::string* file, int number, std::string_view text);

  int number() const { return number_; }           ///< from 1
  Place place() const;                             ///< Barrett.cfg:31
  std::string_view text() const { return text_; }  ///< without blanks at its ends
  bool blank() const { return text_.empty(); }
  int size() const;  ///< words
  /// word i, or "" when there is none
  std::string_view word(int i) const;
  /// The same line without the words from the first that begins with `mark` on.
  Line before(char mark) const;
  /// What to warn of when only the first `used` words are: "2 surplus words are not used"; empty
  /// when there are no more, but for a comment that begins with '#'.
  std::string surplus(int used) const;

  /// throws Error  "Barrett.cfg:31: Kp: expected a number, got 'x'"
  double number(int i, std::string_view what) const;
  /// throws Error as number does, or when out of [low, high]
  int integer(int i, std::string_view what, int low = std::numeric_limits<int>::min(),
              int high = std::numeric_limits<int>::max()) const;
  /// throws Error  "Barrett.cfg:31: joint 2: min 144 exceeds max 0 [deg]"
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw PlacedError(place(), fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  const std::string* file_ = nullptr;
  int number_ = 0;
  std::string_view text_;
  // No list of words, for a line may be as long as a file: how many there are, and the one that was
  // asked for last, from which the next is near.
  mutable int size_ = -1, last_ = -1;
  mutable std::string_view last_word_;
};

/// Walks through the lines of a text.
class LineReader {
 public:
  /// `file` is the name shown in errors
  LineReader(std::string file, std::string text);
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  const std::string& file() const { return file_; }
  bool done() const { return at_ >= text_.size(); }
  /// The next line, blank ones and those that begin with '#' too; stays there.
  /// At the end: an empty line whose place is the last one.
  Line peek() const;
  Line next();
  /// As next(), but steps over blank lines and lines that begin with '#'.
  /// throws Error  "Barrett.cfg:31: expected `what`, got the end of the file"
  Line next_full(std::string_view what);
  /// Steps over blank lines and comments; is there another line?
  bool skip_to_full();
  /// Steps over lines without the character; is there one with it?
  bool skip_to(char mark);
  /// Is it the very first of the next line?
  bool begins_with(char c) const { return !done() && text_[at_] == c; }

 private:
  std::string_view line() const;
  void step();

  std::string file_, text_;
  size_t at_ = 0;   // where the next line begins
  int passed_ = 0;  // lines
};

}  // namespace clench
