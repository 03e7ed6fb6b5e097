// Finds the file of a body or robot, even if the files around it are from another version of a
// model library.
#pragma once
#include "clench/io/text/find_file.h"

namespace clench {

enum class ModelKind { body, robot };

/// As find_file; if that fails, tries the same name with other endings of its kind (for bodies .iv
/// instead of .xml, for robots .cfg instead of .xml, and vice versa) and reports the replacement as
/// a note. The message begins with `place`.
/// throws Error as find_file
std::filesystem::path find_converted(const std::string& name, const std::filesystem::path& referrer,
                                     ModelKind kind, const Place& place,
                                     const ReadOptions& options);

/// As find_converted, for names relative to the root. If that fails, searches the folders next to
/// the root (without a root, next to the folder above the referrer's) whose names begin with the
/// same word: versions of a model library are often stored side by side, like graspit and
/// graspit-xml. The result is reported as repaired. No other folders outside the root are searched.
std::filesystem::path find_model(const std::string& name, const std::filesystem::path& referrer,
                                 ModelKind kind, const Place& place, const ReadOptions& options);

}  // namespace clench
