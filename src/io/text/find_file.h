// Finds files by name.
#pragma once
#include "clench/io/text/read_options.h"

namespace clench {

/// Finds the file `name`, as written in `referrer` (empty: given by the user). Names in files are
/// looked up next to the referrer, below options.folder, below the root and below the referrer's
/// parent folder; names given by the user, models/... and worlds/..., finally below options.home.
/// Backslashes count as slashes, and a name that differs only in case is found.
/// throws Error  "no such file: flsk.iv; did you mean 'flask.iv'?"
///              "expected a file, got a folder: models"
///              "'../flask.iv' lies outside of models, to which reading is confined"
std::filesystem::path find_file(const std::string& name, const std::filesystem::path& referrer,
                                const ReadOptions& options);

/// The same, but returns nothing where find_file throws because the file is missing or not
/// accessible.
std::optional<std::filesystem::path> find_if_any(const std::string& name,
                                                 const std::filesystem::path& referrer,
                                                 const ReadOptions& options);

/// True if the file exists and options.confine allows reading it. Readers use this function, never
/// the file system directly, for names that they generate.
bool is_readable(const std::filesystem::path& file, const ReadOptions& options);
/// throws Error  as find_file, for a file outside options.confine; `name` as shown in the message
[[noreturn]] void fail_outside(const std::string& name, const ReadOptions& options);

/// The absolute path, as stored in specs.
std::string absolute_name(const std::filesystem::path& path);

}  // namespace clench
