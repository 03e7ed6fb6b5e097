#include "clench/base/folder.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/file.h"

namespace clench {

namespace fs = std::filesystem;

[[noreturn]] static void fail_list(const fs::path& folder, const std::error_code& code) {
  const std::string shown = folder.generic_string();
  std::error_code ignored;
  if (code == std::errc::no_such_file_or_directory)
    fail(ErrorKind::file, "no such folder: {}", shown);
  if (code == std::errc::not_a_directory && fs::exists(folder, ignored))
    fail(ErrorKind::file, "{}: expected a folder, got a file", shown);
  if (code == std::errc::not_a_directory) fail(ErrorKind::file, "no such folder: {}", shown);
  fail(ErrorKind::file, "{}: the folder cannot be read: {}", shown, system_reason(code.value()));
}

FolderContents list_folder(const fs::path& folder) {
  FolderContents contents;
  std::error_code code;
  fs::directory_iterator at(folder.empty() ? "." : folder, code);
  for (const fs::directory_iterator end; !code && at != end; at.increment(code)) {
    std::error_code ignored;
    auto& names = at->is_directory(ignored) ? contents.folders : contents.files;
    names.push_back(at->path().filename().string());
  }
  if (code) fail_list(folder, code);
  std::sort(contents.folders.begin(), contents.folders.end());
  std::sort(contents.files.begin(), contents.files.end());
  return contents;
}

void make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    fail(ErrorKind::file, "{}: the folder cannot be created: {}", folder.generic_string(),
         system_reason(code.value()));
}

}  // namespace clench
