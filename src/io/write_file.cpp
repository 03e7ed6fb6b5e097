#include "io/write_file.h"

#include <unistd.h>

#include <fstream>

#include "base/error.h"

namespace clench {

namespace fs = std::filesystem;

void write_file(const fs::path& path, std::string_view text) {
  const std::string name = path.generic_string();
  std::error_code code;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (path.filename().empty() || fs::is_directory(path, code))
    fail("{}: wanted a file to write, got a folder", name);
  if (!fs::is_directory(folder, code))
    fail("{}: the file cannot be written: no such folder: {}", name, folder.generic_string());
  fs::path target = path;
  if (fs::is_symlink(path, code)) target = fs::weakly_canonical(path, code);
  const fs::file_status before = fs::status(target, code);
  if (fs::exists(before) && !fs::is_regular_file(before))
    fail("{}: wanted a file to write, got a special file", name);

  const fs::path part = fmt::format("{}.{}.part", target.string(), getpid());
  std::ofstream out(part, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (fs::exists(before)) fs::permissions(part, before.permissions(), code);
  if (out) fs::rename(part, target, code);
  if (!out || code) {
    const std::string reason = code ? code.message() : "no permission, or no space";
    fs::remove(part, code);
    fail("{}: the file cannot be written: {}", name, reason);
  }
}

}  // namespace clench
