#include <algorithm>

#include "base/file.h"
#include "base/suggest.h"
#include "base/text.h"
#include "io/read.h"

namespace clench {

namespace fs = std::filesystem;

/// Names in a folder, in a fixed order.
static std::vector<std::string> entries(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, code), end; !code && it != end;
       it.increment(code))
    names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// The path itself, or the one that differs in case only; else empty.
static fs::path exact_or_case(const fs::path& path) {
  std::error_code code;
  if (fs::exists(path, code)) return path;
  fs::path found;
  for (const auto& part : path) {
    fs::path next = found.empty() ? part : found / part;
    if (!fs::exists(next, code)) {
      next.clear();
      for (const auto& name : entries(found))
        if (lower_case(name) == lower_case(part.string())) {
          next = found / name;
          break;
        }
      if (next.empty()) return {};
    }
    found = next;
  }
  return found;
}

/// A near name in the folder where the file should be, of the first place that has such a folder.
static std::string suggestion(const std::vector<fs::path>& places) {
  for (const auto& place : places) {
    const fs::path folder = exact_or_case(place.parent_path().empty() ? "." : place.parent_path());
    if (folder.empty()) continue;
    const std::string near = did_you_mean(place.filename().string(), entries(folder));
    if (!near.empty()) return near;
  }
  return "";
}

fs::path find_file(const std::string& name, const fs::path& referrer, const ReadOptions& options) {
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path wanted = slashed;
  if (trim(name).empty()) fail("wanted the name of a file, got nothing");
  if (slashed.find('\0') != std::string::npos || slashed.size() > 4096)
    fail("no such file: {}", in_quotes(name));

  // beside the referrer, below the folder and the root of the call, below the referrer's parent
  // folder; where we stand for the user's own
  std::vector<fs::path> places;
  if (wanted.is_absolute())
    places = {wanted};
  else if (referrer.empty()) {
    places.push_back(wanted);
    if (!options.root.empty()) places.push_back(options.root / wanted);
  } else {
    places.push_back(referrer.parent_path() / wanted);
    if (!options.folder.empty()) places.push_back(options.folder / wanted);
    if (!options.root.empty()) places.push_back(options.root / wanted);
    places.push_back(referrer.parent_path() / ".." / wanted);
  }
  std::error_code code;
  for (const auto& place : places)
    if (fs::is_regular_file(place, code)) return place.lexically_normal();
  for (const auto& place : places)
    if (const fs::path found = exact_or_case(place); fs::is_regular_file(found, code))
      return found.lexically_normal();
  for (const auto& place : places)
    if (const fs::path found = exact_or_case(place); !found.empty())
      fail("wanted a file, got a {}: {}", fs::is_directory(found, code) ? "folder" : "special file",
           name);
  // what the system does not let us see may be there
  for (const auto& place : places)
    if (fs::status(place, code).type() == fs::file_type::none)
      fail("{}: the file cannot be read: {}", name.size() > 200 ? in_quotes(name) : name,
           system_reason(code.value()));
  fail("no such file: {}{}", name, suggestion(places));
}

}  // namespace clench
