// The options of an entry as described by its doc: names and ranges, against which a Table checks
// the arguments of scripts. stdlib/signature/grammar.lua has the complete grammar of docs.
#pragma once
#include <optional>
#include <span>
#include <string>

#include "clench/script/lua/entry.h"

namespace clench {

/// An `@option` line, without those of tables within the table ("verify.lift").
struct DescribedOption {
  std::string name;
  std::optional<double> min, max;
  bool min_open = false;  ///< min itself is excluded
  bool max_open = false;

  bool holds(double x) const;
  /// "> 0", "1 to 1000", ">= 0 and < 1"
  std::string range() const;
};

/// Options of a parameter, by its index from 0; empty if its options are not described line by
/// line. Parsed once, and cached for the lifetime of the program.
std::span<const DescribedOption> described_options(const Entry& entry, int parameter);

}  // namespace clench
