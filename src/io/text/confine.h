// Which files may be read at all: those below one folder, wherever links lead.
#pragma once
#include <filesystem>

namespace clench {

/// Does the path lie below the folder, or is it that folder? An empty folder holds everything.
/// Links are followed, whether there is anything at their end or not, so that the answer tells
/// nothing of what is there.
bool lies_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Does a link that lies in the folder lead out of it? A path that names a place outside by itself
/// does not; nothing leads out of an empty folder.
bool leads_out(const std::filesystem::path& path, const std::filesystem::path& folder);

/// A file to be written, wherever its path names: never through a link that lies in `confine` and
/// leads out of it, as a folder from a stranger may hold one.
/// throws Error  "mug.obj: a link leads out of downloads, to which reading is confined; nothing is
///               written"
void check_target(const std::filesystem::path& file, const std::filesystem::path& confine);

}  // namespace clench
