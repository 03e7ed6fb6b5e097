#include "clench/script/lua/described_options.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <mutex>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace clench {

namespace {

std::string_view without_blanks(std::string_view text) {
  const size_t first = text.find_first_not_of(' ');
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<double> number_in(std::string_view text) {
  double x = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return x;
}

// "> 0", "<= 1", "1 to 1000"; anything else is a unit
void add_bound(DescribedOption& option, std::string_view part) {
  if (const size_t to = part.find(" to "); to != part.npos) {
    const auto low = number_in(part.substr(0, to)), high = number_in(part.substr(to + 4));
    if (low && high) option.min = low, option.max = high;
    return;
  }
  const bool is_low = part.starts_with(">"), closed = part.substr(0, 2).ends_with("=");
  if (!is_low && !part.starts_with("<")) return;
  const auto bound = number_in(without_blanks(part.substr(closed ? 2 : 1)));
  if (!bound) return;
  (is_low ? option.min : option.max) = bound;
  (is_low ? option.min_open : option.max_open) = !closed;
}

// "speed? number [m/s, > 0] = 1"
DescribedOption option_of(std::string_view head) {
  DescribedOption option;
  const size_t blank = head.find(' ');
  option.name = head.substr(0, blank);
  if (option.name.ends_with('?')) option.name.pop_back();
  std::string_view kind = blank == head.npos ? "" : head.substr(blank);
  kind = kind.substr(0, kind.find(" = "));
  const size_t open = kind.find(" ["), close = kind.rfind(']');
  if (open == kind.npos || close == kind.npos) return option;
  std::string_view spec = kind.substr(open + 2, close - open - 2);
  for (size_t comma = 0; comma != spec.npos; spec.remove_prefix(comma + 1)) {
    comma = spec.find(',');
    add_bound(option, without_blanks(spec.substr(0, comma)));
    if (comma == spec.npos) break;
  }
  return option;
}

using OptionsByParameter = std::vector<std::vector<DescribedOption>>;

OptionsByParameter parse_options(std::string_view doc) {
  static constexpr std::string_view param = "@param ", option = "@option ";
  OptionsByParameter found;
  for (size_t end = 0; !doc.empty(); doc.remove_prefix(std::min(doc.size(), end + 1))) {
    end = std::min(doc.find('\n'), doc.size());
    const std::string_view line = doc.substr(0, end);
    if (line.starts_with(param)) found.emplace_back();
    if (!line.starts_with(option) || found.empty()) continue;
    const std::string_view rest = line.substr(option.size());
    DescribedOption one = option_of(rest.substr(0, rest.find("  ")));
    if (one.name.find('.') == one.name.npos) found.back().push_back(std::move(one));
  }
  return found;
}

}  // namespace

bool DescribedOption::holds(double x) const {
  if (min && !(min_open ? x > *min : x >= *min)) return false;
  return !max || (max_open ? x < *max : x <= *max);
}

std::string DescribedOption::range() const {
  if (min && max && !min_open && !max_open) return fmt::format("{} to {}", *min, *max);
  std::string text;
  if (min) text = fmt::format("{} {}", min_open ? ">" : ">=", *min);
  if (min && max) text += " and ";
  if (max) text += fmt::format("{} {}", max_open ? "<" : "<=", *max);
  return text;
}

std::span<const DescribedOption> described_options(const Entry& entry, int parameter) {
  static std::mutex mutex;
  static std::map<const Entry*, OptionsByParameter> known;
  const std::lock_guard lock(mutex);
  auto found = known.find(&entry);
  if (found == known.end()) found = known.emplace(&entry, parse_options(entry.doc)).first;
  const OptionsByParameter& all = found->second;
  if (parameter < 0 || parameter >= static_cast<int>(all.size())) return {};
  return all[static_cast<size_t>(parameter)];
}

}  // namespace clench
