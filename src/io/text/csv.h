// Comma-separated values (RFC 4180): cells of a text, and a text as a cell.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "clench/base/watched.h"

namespace clench {

struct CsvCell {
  std::string text;
  bool quoted = false;  ///< then it is text, whatever it looks like
};

struct CsvRecord {
  int line = 0;  ///< where it begins
  std::vector<CsvCell> cells = {};

  bool is_empty() const { return cells.size() == 1 && !cells[0].quoted && cells[0].text.empty(); }
};

/// The records of a text, one after the other, empty lines too. Lines end in \n, \r\n or \r; a byte
/// order mark is skipped.
class CsvReader {
 public:
  /// file  named in errors; it and the text must outlive the reader
  CsvReader(const std::string& file, std::string_view text, char separator = ',');

  /// The next record, in the memory of an earlier one.
  /// returns  false at the end of the text
  /// throws   Error where a quote is not closed, something follows one, or one stands within a cell
  ///          that does not begin with it, and when a record has more than `max_cells` cells
  bool next(CsvRecord& out);
  /// Does the text end within the last record, read or refused, and within the line in which that
  /// begins? Then it may be cut short.
  bool ends_in_open_line() const {
    return at_ >= text_.size() && text_.find_first_of("\r\n", begin_) == std::string_view::npos;
  }

  static constexpr size_t max_cells = 1'000'000;

 private:
  void quoted(CsvCell& cell, int begin);
  void plain(CsvCell& cell);

  const std::string& file_;
  std::string_view text_;
  std::string ends_;           // of a cell: the separator first
  size_t at_ = 0, begin_ = 0;  // of the last record
  int line_ = 1;
  StopCheck check_{1 << 10};  // of cells
};

/// A text as a cell, in quotes where it would be read otherwise or as a number, true or false.
std::string csv_cell(std::string_view text, char separator = ',');

}  // namespace clench
