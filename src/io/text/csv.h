// Comma-separated values (RFC 4180): cells of a text, and a text as a cell.
#pragma once
#include <string>
#include <string_view>
#include <vector>

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

/// The records of a text, empty lines too. Lines end in \n, \r\n or \r; a byte order mark is
/// skipped.
/// file     named in errors
/// throws   Error where a quote is not closed, something follows one, or one stands within a cell
///          that does not begin with it
std::vector<CsvRecord> read_csv(const std::string& file, std::string_view text,
                                char separator = ',');

/// A text as a cell, in quotes where it would be read otherwise or as a number, true or false.
std::string csv_cell(std::string_view text, char separator = ',');

}  // namespace clench
