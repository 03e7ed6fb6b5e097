// Which files may be read at all: those below one folder, wherever links lead.
#pragma once
#include <filesystem>

namespace clench {

/// Does the path lie below the folder, or is it that folder? An empty folder holds everything.
/// Links are followed, whether there is anything at their end or not, so that the answer tells
/// nothing of what is there.
bool lies_within(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace clench
