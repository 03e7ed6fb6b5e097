// Contents of folders, and new folders.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace clench {

/// Names in a folder, sorted; hidden ones too.
struct FolderContents {
  std::vector<std::string> folders;  ///< and links to folders
  std::vector<std::string> files;    ///< everything else, also devices and dangling links
};

/// An empty path is the current folder.
/// throws Error  "no such folder: models/x", "README.md: expected a folder, got a file", or
///               "/root: the folder cannot be read: Permission denied"
FolderContents list_folder(const std::filesystem::path& folder);

/// Creates a folder and those above it, unless they exist.
/// throws Error  "a/b: the folder cannot be created: Permission denied"
void make_folder(const std::filesystem::path& folder);

}  // namespace clench
