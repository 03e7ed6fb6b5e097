// Where the mesh files are that robot descriptions name: package://, model://, file://, plain
// names.
#pragma once
#include <filesystem>
#include <string>

#include "clench/io/text/find_file.h"

namespace clench {

/// The file that `name` means in the robot file `referrer`. A package is looked up in
/// options.packages, then guessed: a folder of its name beside the referrer or above it, else the
/// nearest folder above the referrer in which the rest of the name is found (a note says which).
/// Backslashes count as slashes, several slashes as one, and names that differ only in case are found
/// after exact ones. Where a name with escapes as "%20" is not found, they are decoded.
/// throws  Error "no package 'shadow' ...", and what find_file throws
std::filesystem::path find_robot_file(const std::string& name,
                                      const std::filesystem::path& referrer,
                                      const ReadOptions& options);

}  // namespace clench
