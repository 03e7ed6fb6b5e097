// The options of an entry as its doc describes them: names and ranges, against which a Table checks
// what scripts give. stdlib/signature/grammar.lua has the whole grammar of docs.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clench/script/lua/entry.h"

namespace clench {

/// An `@option` line.
struct DescribedOption {
  std::string name;
  std::optional<double> min, max;
  bool min_open = false;  ///< min itself is excluded
  bool max_open = false;
  std::vector<DescribedOption> fields = {};  ///< of a table: the option "best.size" of "best"

  bool holds(double x) const;
  /// "> 0", "1 to 1000", ">= 0 and < 1"
  std::string range() const;
};

/// Makes the entries known to which `@like` lines refer: "clench.load", "hand:ik". The lists must
/// outlive the state.
void set_described_entries(lua_State* L, std::span<const Library* const> libraries,
                           std::span<const Class* const> classes);

/// Options of an argument of the running entry, at an index of the stack, or of a table in it:
/// "clench.plot: series[2]" is the subject of a table that the option `series` describes. Empty if
/// they are not described line by line. Parsed once, and kept as long as the program runs.
std::span<const DescribedOption> described_options(lua_State* L, int index,
                                                   std::string_view table_subject);

}  // namespace clench
