// Comma-separated values (RFC 4180): splits a text into cells, and formats a text as a cell.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "clench/base/watched.h"

namespace clench {

struct CsvCell {
  std::string text;
  bool quoted = false;  ///< always text, even if it looks like a number
};

struct CsvRecord {
  int line = 0;  ///< first line of the record
  std::vector<CsvCell> cells = {};

  bool is_empty() const { return cells.size() == 1 && !cells[0].quoted && cells[0].text.empty(); }
};

/// Reads the records of a text in order, including empty lines. Lines end in \n, \r\n or \r; a byte
/// order mark is skipped.
class CsvReader {
 public:
  /// file  named in errors; it and the text must outlive the reader
  CsvReader(const std::string& file, std::string_view text, char separator = ',');

  /// Reads the next record and reuses the memory of `out`.
  /// returns  false at the end of the text
  /// throws   Error if a quote is not closed, text follows a closing quote, a quote is inside a
  ///          cell that does not begin with one, or a record has more than `max_cells` cells
  bool next(CsvRecord& out);
  /// True if the text ends within the last record, read or rejected, on the line on which this
  /// record begins. The record may then be incomplete.
  bool ends_in_open_line() const {
    return at_ >= text_.size() && text_.find_first_of("\r\n", begin_) == std::string_view::npos;
  }

  static constexpr size_t max_cells = 1'000'000;

 private:
  void quoted(CsvCell& cell, int begin);
  void plain(CsvCell& cell);

  const std::string& file_;
  std::string_view text_;
  std::string ends_;           // characters that end a cell: the separator first
  size_t at_ = 0, begin_ = 0;  // begin_: start of the last record
  int line_ = 1;
  StopCheck check_{1 << 10};  // per cell
};

/// A text as a cell; quoted if it would otherwise be read differently, or as a number, true or
/// false.
std::string csv_cell(std::string_view text, char separator = ',');

}  // namespace clench
