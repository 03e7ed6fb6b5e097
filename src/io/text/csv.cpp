#include "clench/io/text/csv.h"

#include <algorithm>

#include "clench/base/text.h"
#include "clench/base/watched.h"

namespace clench {

namespace {

class Scanner {
 public:
  Scanner(const std::string& file, std::string_view text, char separator)
      : file_(file), text_(text), ends_{separator, '\r', '\n'} {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  }
  bool done() const { return at_ >= text_.size(); }

  CsvRecord record() {
    CsvRecord out{.line = line_};
    while (true) {
      check_();
      out.cells.push_back(text_.substr(at_).starts_with('"') ? quoted(out.line) : plain());
      if (done() || text_[at_] != ends_[0]) break;
      ++at_;
    }
    if (!done() && text_[at_] == '\r') ++at_;
    if (!done() && text_[at_] == '\n') ++at_;
    ++line_;
    return out;
  }

 private:
  CsvCell quoted(int begin) {
    CsvCell cell{.text = {}, .quoted = true};
    for (++at_;; ++at_) {
      if (done()) fail("{}:{}: a quote that is not closed", file_, begin);
      if (text_[at_] == '"' && text_.substr(++at_, 1) != "\"") break;
      line_ += text_[at_] == '\n';
      cell.text += text_[at_];
    }
    if (!done() && ends_.find(text_[at_]) == std::string::npos)
      fail("{}:{}: expected a separator or the line's end behind the quote, got {}", file_, line_,
           in_quotes(std::string(text_.substr(at_, 1))));
    return cell;
  }
  CsvCell plain() {
    const size_t end = std::min(text_.find_first_of(ends_, at_), text_.size());
    CsvCell cell{.text = std::string(text_.substr(at_, end - at_))};
    if (cell.text.find('"') != std::string::npos)
      fail("{}:{}: a quote within {}, which does not begin with one", file_, line_,
           in_quotes(cell.text));
    at_ = end;
    return cell;
  }

  const std::string& file_;
  std::string_view text_;
  std::string ends_;  // of a cell: the separator first
  size_t at_ = 0;
  int line_ = 1;
  StopCheck check_{1 << 10};  // of cells
};

}  // namespace

std::vector<CsvRecord> read_csv(const std::string& file, std::string_view text, char separator) {
  Scanner scanner(file, text, separator);
  std::vector<CsvRecord> out;
  while (!scanner.done()) out.push_back(scanner.record());
  return out;
}

std::string csv_cell(std::string_view text, char separator) {
  const std::string special = {'"', '\r', '\n', separator};
  static constexpr std::string_view values[] = {"true", "false", "nan", "inf", "-inf"};
  const bool plain = !text.empty() && text.find_first_of(special) == std::string_view::npos &&
                     trim(text).size() == text.size() && !parse_number(text) &&
                     text.find_first_of("0123456789+-.") != 0 &&
                     std::ranges::find(values, text) == std::end(values);
  if (plain) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

}  // namespace clench
