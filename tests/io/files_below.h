// Lists the files in a folder and its subfolders.
#pragma once
#include <algorithm>
#include <filesystem>

#include "clench/base/text.h"

namespace clench::test {

/// sorted by path; empty if there is no such folder
/// extensions  in lower case, with the dot
inline std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& extensions) {
  std::vector<std::filesystem::path> out;
  if (!std::filesystem::is_directory(folder)) return out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (std::ranges::count(extensions, lower_case(entry.path().extension().string())) > 0)
      out.push_back(entry.path());
  std::ranges::sort(out);
  return out;
}

}  // namespace clench::test
