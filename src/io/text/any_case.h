// Names of files as other systems spell them: in another case, with back-slashes.
#pragma once
#include <string>
#include <vector>

#include "clench/io/text/read_options.h"

namespace clench {

/// Names in a folder, in a fixed order.
std::vector<std::string> names_in_folder(const std::filesystem::path& folder);
/// The path itself, or the one that differs in case only; empty when there is neither.
std::filesystem::path exact_or_case(const std::filesystem::path& path);
/// The readable file at that path, else one whose path differs only in case; empty when there is
/// none.
std::filesystem::path find_in_any_case(const std::filesystem::path& file,
                                       const ReadOptions& options);
/// Slashes in place of back-slashes, as files written on Windows have them.
std::string with_slashes(std::string name);

}  // namespace clench
