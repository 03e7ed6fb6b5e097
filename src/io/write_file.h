// Text into a file, whole or not at all.
#pragma once
#include <filesystem>
#include <string_view>

namespace clench {

/// Writes beside the file and then takes its place: whatever goes wrong, the old file stays as it
/// was. A link is followed.
/// throws Error  "out/a.vgr: the file cannot be written: no such folder: out"
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace clench
