// Restricts reading and writing to files below one folder, with links resolved.
#pragma once
#include <filesystem>

namespace clench {

/// True if the path is the folder or lies below it; always true for an empty folder. Links are
/// followed even if their targets do not exist, so that the answer does not reveal which files
/// exist.
bool lies_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// True if a link inside the folder leads out of it. False for paths that name a place outside the
/// folder directly, and for an empty folder.
bool leads_out(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Checks a file before it is written. Its path may be outside `confine`, but must not leave it
/// through a link inside it: a folder received from a stranger may contain such links.
/// throws Error  "mug.obj: a link leads out of downloads, to which reading is confined; nothing is
///              written"
void check_target(const std::filesystem::path& file, const std::filesystem::path& confine);

}  // namespace clench
