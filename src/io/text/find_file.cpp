#include "clench/io/text/find_file.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "clench/base/file.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/io/text/any_case.h"
#include "clench/io/text/confine.h"

namespace clench {

namespace fs = std::filesystem;

/// A similar name in the folder of the first candidate path whose folder exists.
static std::string suggestion(const std::vector<fs::path>& places, const ReadOptions& options) {
  for (const auto& place : places) {
    const fs::path folder = exact_or_case(place.parent_path().empty() ? "." : place.parent_path());
    if (folder.empty() || !lies_within(folder, options.confine)) continue;
    const std::string near = did_you_mean(place.filename().string(), names_in_folder(folder));
    if (!near.empty()) return near;
  }
  return "";
}

/// Candidate paths for a name: next to the referrer, below the folder and the root of the call,
/// below the referrer's parent folder; for names given by the user, in the current folder and in
/// the folder of the installed models.
static std::vector<fs::path> places_of(const fs::path& name, const fs::path& referrer,
                                       const ReadOptions& options) {
  if (name.is_absolute()) return {name.lexically_normal()};
  const fs::path here = referrer.parent_path();
  std::vector<fs::path> places = {here / name};
  if (!referrer.empty() && !options.folder.empty()) places.push_back(options.folder / name);
  if (!options.root.empty()) places.push_back(options.root / name);
  if (!referrer.empty()) places.push_back(here / ".." / name);
  const fs::path first = name.empty() ? name : *name.begin();
  if (referrer.empty() && !options.home.empty() && (first == "models" || first == "worlds"))
    places.push_back(options.home / name);
  for (auto& place : places) place = place.lexically_normal();
  return places;
}

bool is_readable(const fs::path& file, const ReadOptions& options) {
  std::error_code code;
  return lies_within(file, options.confine) && fs::is_regular_file(file, code);
}

void fail_outside(const std::string& name, const ReadOptions& options) {
  fail(ErrorKind::file, "'{}' lies outside of {}, to which reading is confined", name,
       options.confine.generic_string());
}

/// The path exists but is not a regular file, or is a dangling link.
[[noreturn]] static void fail_no_file(const fs::path& found, const std::string& shown) {
  std::error_code code;
  const fs::file_type type = fs::status(found, code).type();
  if (type == fs::file_type::not_found)
    fail(ErrorKind::file, "no such file: {}, a link that leads to nothing", shown);
  if (type == fs::file_type::none)
    fail(ErrorKind::file, "{}: the file cannot be read: {}", shown, system_reason(code.value()));
  fail(ErrorKind::file, "expected a file, got a {}: {}",
       type == fs::file_type::directory ? "folder" : "special file", shown);
}

fs::path find_file(const std::string& name, const fs::path& referrer, const ReadOptions& options) {
  const std::string slashed = with_slashes(name);
  if (trim(name).empty()) fail(ErrorKind::file, "expected the name of a file, got nothing");
  if (slashed.find('\0') != std::string::npos || slashed.size() > 4096)
    fail(ErrorKind::file, "no such file: {}", in_quotes(name));

  // a backslash may be part of the name itself; that is tried first
  std::vector<fs::path> places;
  if (slashed != name) places = places_of(name, referrer, options);
  std::ranges::copy(places_of(slashed, referrer, options), std::back_inserter(places));
  // no file outside `confine` is accessed, so that messages do not reveal its existence
  std::erase_if(places, [&](const auto& place) { return !lies_within(place, options.confine); });
  // names from files are shortened like all quoted contents; names given by the user are shown
  // completely
  const std::string shown = referrer.empty() ? name : excerpt(name);
  if (places.empty()) fail_outside(shown, options);
  for (const auto& place : places)
    if (is_readable(place, options)) return place;
  for (const auto& place : places)
    if (const fs::path found = find_in_any_case(place, options); !found.empty()) return found;
  std::error_code code;
  for (const auto& place : places)
    if (const fs::path found = exact_or_case(place);
        !found.empty() && lies_within(found, options.confine))
      fail_no_file(found, shown);
  // a path for which the system denies access may exist
  for (const auto& place : places)
    if (fs::status(place, code).type() == fs::file_type::none)
      fail(ErrorKind::file, "{}: the file cannot be read: {}", shown, system_reason(code.value()));
  fail(ErrorKind::file, "no such file: {}{}", shown, suggestion(places, options));
}

std::optional<fs::path> find_if_any(const std::string& name, const fs::path& referrer,
                                    const ReadOptions& options) {
  try {
    return find_file(name, referrer, options);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::file) throw;
    return {};
  }
}

std::string absolute_name(const fs::path& path) {
  return fs::absolute(path).lexically_normal().generic_string();
}

}  // namespace clench
