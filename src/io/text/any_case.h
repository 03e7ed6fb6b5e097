// File names as spelled on other systems: in different case, with backslashes.
#pragma once
#include <string>
#include <vector>

#include "clench/io/text/read_options.h"

namespace clench {

/// Names in a folder, in a fixed order.
std::vector<std::string> names_in_folder(const std::filesystem::path& folder);
/// The path itself, or the path that differs only in case; empty if there is neither.
std::filesystem::path exact_or_case(const std::filesystem::path& path);
/// The readable file at that path, otherwise one whose path differs only in case; empty if there is
/// none.
std::filesystem::path find_in_any_case(const std::filesystem::path& file,
                                       const ReadOptions& options);
/// Replaces backslashes, as in files written on Windows, by slashes.
std::string with_slashes(std::string name);

}  // namespace clench
