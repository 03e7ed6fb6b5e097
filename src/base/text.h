// Parses text files: lines, words, and validated numbers. Errors state the place as "file:line",
// the expected and the actual value.
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

/// Removes the byte order mark that some editors put before UTF-8.
std::string_view without_mark(std::string_view text);
/// Removes such a mark; line ends of every kind become '\n'.
std::string plain_text(std::string raw);
/// A complete file as plain text.
/// throws  as read_bytes, and if it is larger than 256 MB
std::string read_text(const std::filesystem::path& path);

/// A finite decimal number, an explicit '+' allowed, with nothing before or after it; otherwise
/// empty.
std::optional<double> parse_number(std::string_view text);
std::optional<int> parse_integer(std::string_view text);
/// Describes why a word is not an integer from `low` to `high`: "expected a whole number from 1 to
/// 9, got 12"; empty if it is one.
std::string integer_fault(std::string_view word, int low, int high);

std::string_view trim(std::string_view text);
std::string lower_case(std::string_view text);
/// The first `most` words, separated by white space and any of `separators`.
std::vector<std::string_view> split_words(std::string_view text, std::string_view separators = "",
                                          size_t most = std::string_view::npos);
/// Size of the character that begins at i [bytes]; 0 if it is not UTF-8.
size_t utf8_size(std::string_view text, size_t i);
/// The characters of UTF-8 text; each invalid byte becomes U+FFFD, or its Latin-1 character.
std::u32string letters_of(std::string_view text, bool or_latin1 = false);
/// Encodes characters as UTF-8.
std::string text_of(std::u32string_view letters);
/// Longest excerpt of a file quoted in a message [characters]
constexpr size_t max_excerpt = 120;
/// A word for a message: truncated if long, with unprintable characters as '?'.
std::string excerpt(std::string_view text);
/// The same in quotes; "nothing" if empty.
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

/// A line and its place. The text belongs to the LineReader that returned it.
class Line {
 public:
  Line() = default;
  Line(const std::string* file, int number, std::string_view text);

  int number() const { return number_; }           ///< from 1
  Place place() const;                             ///< Barrett.cfg:31
  std::string_view text() const { return text_; }  ///< without leading and trailing blanks
  bool blank() const { return text_.empty(); }
  int size() const;  ///< number of words
  /// word i, or "" if there is none
  std::string_view word(int i) const;
  /// The same line up to the first word that begins with `mark`.
  Line before(char mark) const;
  /// Warning if there are more than the first `used` words: "2 surplus words are not used"; empty
  /// if there are none, except a comment that begins with '#'.
  std::string surplus(int used) const;

  /// throws Error  "Barrett.cfg:31: Kp: expected a number, got 'x'"
  double number(int i, std::string_view what) const;
  /// throws Error as number does, or if out of [low, high]
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
  // Words are not stored, because a line may be as long as a file: only their number, and the last
  // requested one, from which the next is found quickly.
  mutable int size_ = -1, last_ = -1;
  mutable std::string_view last_word_;
};

/// Iterates over the lines of a text.
class LineReader {
 public:
  /// `file` is the name shown in errors
  LineReader(std::string file, std::string text);
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  const std::string& file() const { return file_; }
  bool done() const { return at_ >= text_.size(); }
  /// The next line, including blank ones and comments that begin with '#'; does not advance. At the
  /// end: an empty line with the place of the last one.
  Line peek() const;
  Line next();
  /// As next(), but skips blank lines and lines that begin with '#'.
  /// throws Error  "Barrett.cfg:31: expected `what`, got the end of the file"
  Line next_full(std::string_view what);
  /// Skips blank lines and comments; is there another line?
  bool skip_to_full();
  /// Skips lines without the character; is there one with it?
  bool skip_to(char mark);
  /// Is it the first character of the next line?
  bool begins_with(char c) const { return !done() && text_[at_] == c; }

 private:
  std::string_view line() const;
  void step();

  std::string file_, text_;
  size_t at_ = 0;   // start of the next line
  int passed_ = 0;  // number of lines read
};

}  // namespace clench
