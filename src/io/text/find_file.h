// Where the file is that a name means.
#pragma once
#include "clench/io/text/read_options.h"

namespace clench {

/// Where `name`, as written in `referrer` (empty: given by the user), is found: beside the
/// referrer, below options.folder, below the root, below the referrer's parent folder; of the
/// user's own, models/... and worlds/..., at last below options.home. Back-slashes count as
/// slashes, and a name that differs only in case is found.
/// throws Error  "no such file: flsk.iv; did you mean 'flask.iv'?"  "expected a file, got a folder:
///               models" "'../flask.iv' lies outside of models, to which reading is confined"
std::filesystem::path find_file(const std::string& name, const std::filesystem::path& referrer,
                                const ReadOptions& options);

/// The same; empty where find_file tells of a file that cannot be had.
std::optional<std::filesystem::path> find_if_any(const std::string& name,
                                                 const std::filesystem::path& referrer,
                                                 const ReadOptions& options);

/// Is there a file, and may the options' caller read it? Readers ask this, and never the disk,
/// about names that they make up.
bool is_readable(const std::filesystem::path& file, const ReadOptions& options);
/// throws Error  as find_file, of something, named as it is to be shown, outside options.confine
[[noreturn]] void fail_outside(const std::string& name, const ReadOptions& options);

/// The path from the root of the file system, as specs keep it.
std::string absolute_name(const std::filesystem::path& path);

}  // namespace clench
