#include "clench/io/text/any_case.h"

#include <algorithm>

#include "clench/base/text.h"
#include "clench/io/text/confine.h"

namespace clench {

namespace fs = std::filesystem;

std::vector<std::string> names_in_folder(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, code), end; !code && it != end;
       it.increment(code))
    names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path exact_or_case(const fs::path& path) {
  std::error_code code;
  if (fs::exists(path, code)) return path;
  fs::path found;
  for (const auto& part : path) {
    fs::path next = found.empty() ? part : found / part;
    if (!fs::exists(next, code)) {
      next.clear();
      for (const auto& name : names_in_folder(found))
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

fs::path find_in_any_case(const fs::path& file, const ReadOptions& options) {
  if (!lies_within(file, options.confine)) return {};
  const fs::path found = exact_or_case(file);
  std::error_code code;
  const bool readable = lies_within(found, options.confine) && fs::is_regular_file(found, code);
  return readable ? found : fs::path();
}

std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

}  // namespace clench
