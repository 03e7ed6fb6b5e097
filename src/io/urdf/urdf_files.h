// Finds the mesh files named in robot descriptions: package://, model://, file://, plain names.
#pragma once
#include <filesystem>
#include <string>

#include "clench/io/text/find_file.h"

namespace clench {

/// The file named `name` in the robot file `referrer`. A package is looked up in options.packages;
/// otherwise it is guessed: a folder of its name next to the referrer or above it, otherwise the
/// nearest folder above the referrer that contains the rest of the name (reported as a note).
/// Backslashes count as slashes, multiple slashes as one, and exact names are preferred to names
/// that differ in case. If a name with escapes such as "%20" is not found, it is decoded.
/// throws  Error "no package 'shadow' ...", and the errors of find_file
std::filesystem::path find_robot_file(const std::string& name,
                                      const std::filesystem::path& referrer,
                                      const ReadOptions& options);

}  // namespace clench
