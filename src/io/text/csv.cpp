#include "clench/io/text/csv.h"

#include <algorithm>

#include "clench/base/text.h"
#include "clench/base/watched.h"

namespace clench {

CsvReader::CsvReader(const std::string& file, std::string_view text, char separator)
    : file_(file), text_(without_mark(text)), ends_{separator, '\r', '\n'} {}

bool CsvReader::next(CsvRecord& out) {
  if (at_ >= text_.size()) return false;
  out.line = line_;
  begin_ = at_;
  size_t count = 0;
  for (;; ++at_) {
    if (count == max_cells)
      fail("{}:{}: expected at most {} cells in a line, got more", file_, out.line, max_cells);
    check_();
    if (count == out.cells.size()) out.cells.emplace_back();
    CsvCell& cell = out.cells[count++];
    if (text_.substr(at_).starts_with('"'))
      quoted(cell, out.line);
    else
      plain(cell);
    if (at_ >= text_.size() || text_[at_] != ends_[0]) break;
  }
  out.cells.resize(count);
  if (at_ < text_.size() && text_[at_] == '\r') ++at_;
  if (at_ < text_.size() && text_[at_] == '\n') ++at_;
  ++line_;
  return true;
}

void CsvReader::quoted(CsvCell& cell, int begin) {
  cell.text.clear();
  cell.quoted = true;
  for (++at_;; ++at_) {
    if (at_ >= text_.size()) fail("{}:{}: a quote that is not closed", file_, begin);
    if (text_[at_] == '"' && text_.substr(++at_, 1) != "\"") break;
    line_ += text_[at_] == '\n';
    cell.text += text_[at_];
  }
  if (at_ < text_.size() && ends_.find(text_[at_]) == std::string::npos)
    fail("{}:{}: expected a separator or the line's end behind the quote, got {}", file_, line_,
         in_quotes(text_.substr(at_, 1)));
}

void CsvReader::plain(CsvCell& cell) {
  const size_t end = std::min(text_.find_first_of(ends_, at_), text_.size());
  cell.text = text_.substr(at_, end - at_);
  cell.quoted = false;
  if (cell.text.find('"') != std::string::npos)
    fail("{}:{}: a quote within {}, which does not begin with one", file_, line_,
         in_quotes(cell.text));
  at_ = end;
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
