#include "clench/script/lua/described_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <mutex>

#include <fmt/format.h>

#include "clench/base/error.h"

namespace clench {

namespace {

std::string_view without_blanks(std::string_view text) {
  const size_t first = text.find_first_not_of(' ');
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Takes the text before the next mark, or all of it, from the text.
std::string_view take_part(std::string_view& text, char mark) {
  const size_t end = std::min(text.find(mark), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + 1));
  return without_blanks(part);
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
  option.name = take_part(head, ' ');
  if (option.name.ends_with('?')) option.name.pop_back();
  std::string_view kind = without_blanks(head.substr(0, head.find(" = ")));
  if (kind.starts_with("index")) option.min = 1;
  const size_t open = kind.find(" ["), close = kind.rfind(']');
  if (open == kind.npos || close == kind.npos) return option;
  std::string_view spec = kind.substr(open + 2, close - open - 2);
  while (!spec.empty()) add_bound(option, take_part(spec, ','));
  return option;
}

using Options = std::vector<DescribedOption>;

DescribedOption* find(Options& options, std::string_view name) {
  const auto found = std::ranges::find(options, name, &DescribedOption::name);
  return found == options.end() ? nullptr : &*found;
}

// to the list, or as a field of the option that its name begins with
void add_option(Options& options, DescribedOption option) {
  Options* list = &options;
  std::string_view name = option.name;
  while (name.find('.') != name.npos) {
    DescribedOption* outer = find(*list, take_part(name, '.'));
    if (!outer) fail(ErrorKind::internal, "the option {} follows no option", option.name);
    list = &outer->fields;
  }
  option.name = std::string(name);
  list->push_back(std::move(option));
}

struct DescribedParameter {
  std::string name;
  Options options;
};

using Parameters = std::vector<DescribedParameter>;

struct Entries {
  std::span<const Library* const> libraries;
  std::span<const Class* const> classes;

  const Entry* find(std::string_view name) const;
};

const Entry* find_among(std::span<const Entry> entries, std::string_view name) {
  const auto found = std::ranges::find(entries, name, &Entry::name);
  return found == entries.end() ? nullptr : &*found;
}

const Entry* Entries::find(std::string_view name) const {
  const size_t mark = name.find_last_of(".:");
  if (mark == name.npos) return nullptr;
  const std::string_view owner = name.substr(0, mark), key = name.substr(mark + 1);
  const Entry* found = nullptr;
  for (const Library* library : libraries)
    if (!found && library->name == owner) found = find_among(library->functions, key);
  for (const Class* kind : classes)
    if (!found && kind->variable == owner) found = find_among(kind->methods, key);
  return found;
}

/// The parsed docs of entries; @like lines refer to others.
class Descriptions {
 public:
  const Parameters& of(const Entry& entry, const Entries& entries) {
    auto found = known_.find(&entry);
    if (found == known_.end()) found = known_.emplace(&entry, parse(entry.doc, entries)).first;
    return found->second;
  }

 private:
  Parameters parse(std::string_view doc, const Entries& entries) {
    Parameters found;
    while (!doc.empty()) {
      std::string_view line = doc.substr(0, doc.find('\n'));
      doc.remove_prefix(std::min(doc.size(), line.size() + 1));
      const std::string_view tag = line.starts_with('@') ? take_part(line, ' ') : "";
      const std::string_view head = line.substr(0, line.find("  "));
      if (tag == "@param") found.push_back({option_of(head).name, {}});
      if (found.empty()) continue;
      if (tag == "@option") add_option(found.back().options, option_of(head));
      if (tag == "@like") add_like(found.back().options, head, line.substr(head.size()), entries);
    }
    return found;
  }

  // "clench.load", "root, strict": these options of the other entry, or all
  void add_like(Options& options, std::string_view name, std::string_view names,
                const Entries& entries) {
    const Entry* entry = entries.find(name);
    Options from;
    if (entry)
      for (const DescribedParameter& parameter : of(*entry, entries))
        if (from.empty()) from = parameter.options;
    if (names.empty())
      for (const DescribedOption& option : from)
        if (!find(options, option.name)) options.push_back(option);
    while (!names.empty()) {
      const std::string_view wanted = take_part(names, ',');
      const DescribedOption* option = find(from, wanted);
      if (!option) fail(ErrorKind::internal, "@like {}: it has no option {}", name, wanted);
      if (!find(options, wanted)) options.push_back(*option);
    }
  }

  std::map<const Entry*, Parameters> known_;
};

// its address is the registry key of the Entries
const char entries_key = 0;

Entries entries_of(lua_State* L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &entries_key);
  const auto* entries = static_cast<const Entries*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return entries ? *entries : Entries{};
}

const Parameters& parameters_of(lua_State* L, const Entry& entry) {
  static std::mutex mutex;
  static Descriptions descriptions;
  const Entries entries = entries_of(L);
  const std::lock_guard lock(mutex);
  return descriptions.of(entry, entries);
}

// the name of the parameter or option, without the number of an item: "series[2]"
template <class List>
const Options* options_named(const List& list, std::string_view name, auto options) {
  name = name.substr(0, name.find('['));
  for (const auto& one : list)
    if (one.name == name) return &(one.*options);
  return nullptr;
}

// "series[2]: style": of a table in a parameter or in an option of one
const Options* nested(const Parameters& parameters, std::string_view path) {
  const auto step = [&path] {
    const std::string_view name = path.substr(0, path.find(": "));
    path.remove_prefix(std::min(path.size(), name.size() + 2));
    return name;
  };
  const std::string_view first = step();
  const Options* found = options_named(parameters, first, &DescribedParameter::options);
  for (const DescribedParameter& parameter : parameters)
    if (!found || found->empty())
      found = options_named(parameter.options, first, &DescribedOption::fields);
  while (found && !path.empty()) found = options_named(*found, step(), &DescribedOption::fields);
  return found;
}

}  // namespace

bool DescribedOption::holds(double x) const {
  if (min && !(min_open ? x > *min : x >= *min)) return false;
  return !max || (max_open ? x < *max : x <= *max);
}

// "1000000", "1e+12", "0.5"
static std::string bound_text(double x) {
  return std::abs(x) < 1e7 ? fmt::format("{}", x) : fmt::format("{:g}", x);
}

std::string DescribedOption::range() const {
  if (min && max && !min_open && !max_open)
    return fmt::format("{} to {}", bound_text(*min), bound_text(*max));
  std::string text;
  if (min) text = fmt::format("{} {}", min_open ? ">" : ">=", bound_text(*min));
  if (min && max) text += " and ";
  if (max) text += fmt::format("{} {}", max_open ? "<" : "<=", bound_text(*max));
  return text;
}

void set_described_entries(lua_State* L, std::span<const Library* const> libraries,
                           std::span<const Class* const> classes) {
  *static_cast<Entries*>(lua_newuserdatauv(L, sizeof(Entries), 0)) = {libraries, classes};
  lua_rawsetp(L, LUA_REGISTRYINDEX, &entries_key);
}

std::span<const DescribedOption> described_options(lua_State* L, int index,
                                                   std::string_view table_subject) {
  const Entry* entry = running_entry(L);
  if (!entry) return {};
  const std::string subject = clench::subject(L);
  if (!table_subject.starts_with(subject)) return {};
  const Parameters& parameters = parameters_of(L, *entry);
  table_subject.remove_prefix(subject.size());
  if (table_subject.starts_with(": ")) {
    const Options* found = nested(parameters, table_subject.substr(2));
    return found ? std::span<const DescribedOption>(*found) : std::span<const DescribedOption>();
  }
  const int parameter = index - (running_class(L) ? 2 : 1);
  if (!table_subject.empty() || parameter < 0 || parameter >= static_cast<int>(parameters.size()))
    return {};
  return parameters[static_cast<size_t>(parameter)].options;
}

}  // namespace clench
