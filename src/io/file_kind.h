// What a file describes, told from its ending and, in XML, from its outermost element.
#pragma once
#include <filesystem>

namespace clench {

enum class FileKind { body, robot, world, eigengrasps, virtual_contacts };

/// path  of a file that exists
/// throws Error  "notes.txt: wanted a model, a world, eigengrasps or virtual contacts, got '.txt'"
FileKind file_kind(const std::filesystem::path& path);

/// "body", "robot", "world", "eigengrasps", "virtual contacts"
const char* kind_name(FileKind kind);

}  // namespace clench
