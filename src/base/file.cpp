#include "clench/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <random>
#include <system_error>
#include <utility>

#include "clench/base/error.h"

namespace clench {

namespace fs = std::filesystem;

std::string system_reason(int error) { return std::generic_category().message(error); }

namespace {

/// An open file, closed by the destructor.
class OpenFile {
 public:
  explicit OpenFile(int number) : number_(number) {}
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  /// A full disk may be reported only here.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

// --- reading ---

constexpr size_t max_bytes = size_t{1} << 30;

[[noreturn]] void fail_read(const fs::path& path, int error) {
  if (error == ENOENT) fail(ErrorKind::file, "no such file: {}", path.generic_string());
  fail(ErrorKind::file, "{}: the file cannot be read: {}", path.generic_string(),
       system_reason(error));
}

void check_regular(const fs::path& path, const struct stat& status) {
  if (!S_ISREG(status.st_mode))
    fail(ErrorKind::file, "{}: expected a file, got a {}", path.generic_string(),
         S_ISDIR(status.st_mode) ? "folder" : "special file");
}

/// At most `count` bytes; `status` is the file's.
std::string read_at_most(const fs::path& path, size_t count, struct stat& status) {
  // checked before opening, which can have an effect on devices, and again afterwards
  if (::stat(path.c_str(), &status) != 0) fail_read(path, errno);
  check_regular(path, status);
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file || ::fstat(file.number(), &status) != 0) fail_read(path, errno);
  check_regular(path, status);
  std::string out(std::min(static_cast<size_t>(status.st_size), count), '\0');
  size_t at = 0;
  while (at < out.size()) {
    const ssize_t got = ::read(file.number(), out.data() + at, out.size() - at);
    if (got < 0 && errno != EINTR) fail_read(path, errno);
    if (got == 0) break;
    if (got > 0) at += static_cast<size_t>(got);
  }
  out.resize(at);
  return out;
}

}  // namespace

std::string read_bytes(const fs::path& path) {
  struct stat status;
  std::string out = read_at_most(path, max_bytes, status);
  if (static_cast<size_t>(status.st_size) > max_bytes)
    fail(ErrorKind::file, "{}: expected a file of at most 1 GB, got {} bytes",
         path.generic_string(), status.st_size);
  return out;
}

std::string read_start(const fs::path& path, size_t count) {
  struct stat status;
  return read_at_most(path, count, status);
}

// --- writing ---

namespace {

[[noreturn]] void fail_write(const fs::path& path, int error) {
  fail(ErrorKind::file, "{}: the file cannot be written: {}", path.generic_string(),
       system_reason(error));
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A hidden name in the same folder, short enough for any file system.
fs::path unused_name(const fs::path& beside) {
  constexpr size_t max_stem = 100, max_ending = 20;
  std::random_device random;
  const std::string ending = beside.extension().string();
  return folder_of(beside) /
         fmt::format(".{}.{:08x}{:08x}{}", beside.stem().string().substr(0, max_stem), random(),
                     random(), ending.substr(0, ending.size() > max_ending ? 0 : max_ending));
}

/// Returns false, with errno, if the text could not be written completely.
bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t put = ::write(file, text.data(), text.size());
    if (put < 0 && errno != EINTR) return false;
    if (put > 0) text.remove_prefix(static_cast<size_t>(put));
  }
  return true;
}

}  // namespace

Draft::Draft(const fs::path& beside, std::string_view text, unsigned mode) {
  // an existing name, possibly a link, is never used
  constexpr int max_names = 100;
  int number = -1;
  for (int i = 0; number < 0 && i < max_names; ++i) {
    path_ = unused_name(beside);
    number = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (number < 0 && errno != EEXIST) break;
  }
  if (number < 0) fail_write(beside, errno);
  OpenFile file(number);
  const bool written = write_all(file.number(), text) && ::fsync(file.number()) == 0;
  int error = written ? 0 : errno;
  if (!file.close() && written) error = errno;
  if (error == 0) return;
  ::unlink(path_.c_str());
  fail_write(beside, error);
}

Draft::~Draft() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

void Draft::move_to(const fs::path& target) {
  if (::rename(path_.c_str(), target.c_str()) != 0) fail_write(target, errno);
  path_.clear();
}

/// As move_to, with the permissions of the existing file, which the text has from the beginning,
/// except set-user-ID and similar bits: they were granted to another text.
static void write_over(const fs::path& target, std::string_view text, mode_t mode) {
  Draft draft(target, text, mode & 0777);
  ::chmod(draft.path().c_str(), mode & 0777);
  draft.move_to(target);
}

/// Destination of the text: the file itself, or the target of a link.
static fs::path target_of(const fs::path& path) {
  if (!fs::is_symlink(fs::symlink_status(path))) return path;
  const fs::path next = folder_of(path) / fs::read_symlink(path);
  std::error_code code;
  const fs::path end = fs::canonical(next, code);
  return code ? fs::weakly_canonical(next) : end;
}

void check_folder_of(const fs::path& file) {
  struct stat status;
  if (::stat(folder_of(file).c_str(), &status) == 0) return;
  if (errno != ENOENT) fail_write(file, errno);
  fail(ErrorKind::file, "{}: the file cannot be written: no such folder: {}", file.generic_string(),
       folder_of(file).generic_string());
}

/// Rejects folders, special files and files without write permission.
/// returns  the file that the path leads to, and its status if it exists
static std::pair<fs::path, std::optional<struct stat>> find_target(const fs::path& path) {
  struct stat before;
  if (path.empty()) fail(ErrorKind::file, "expected the name of a file, got nothing");
  if (path.filename().empty() || (::stat(path.c_str(), &before) == 0 && S_ISDIR(before.st_mode)))
    fail(ErrorKind::file, "{}: expected a file to write, got a folder", path.generic_string());
  check_folder_of(path);
  const fs::path target = target_of(path);
  if (::stat(target.c_str(), &before) != 0) {
    if (errno != ENOENT) fail_write(path, errno);
    return {target, std::nullopt};
  }
  if (!S_ISREG(before.st_mode))
    fail(ErrorKind::file, "{}: expected a file to write, got a special file",
         path.generic_string());
  if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail_write(path, errno);
  return {target, before};
}

/// Calls `write`; errors of the file system become errors of the path.
template <class Write>
static void with_errors_of(const fs::path& path, Write&& write) {
  try {
    write();
  } catch (const fs::filesystem_error& error) {
    fail_write(path, error.code().value());
  }
}

void write_file(const fs::path& path, std::string_view text) {
  with_errors_of(path, [&] {
    const auto [target, before] = find_target(path);
    if (before)
      write_over(target, text, before->st_mode);
    else
      Draft(target, text).move_to(target);
  });
}

void check_writable(const fs::path& path) {
  with_errors_of(path, [&] { const Draft draft(find_target(path).first, ""); });
}

void append_file(const fs::path& path, std::string_view text) {
  with_errors_of(path, [&] {
    const fs::path target = find_target(path).first;
    const OpenFile file(
        ::open(target.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666));
    struct stat before;
    if (!file || ::fstat(file.number(), &before) != 0) fail_write(path, errno);
    char last = '\n';
    if (before.st_size > 0 && ::pread(file.number(), &last, 1, before.st_size - 1) != 1)
      fail_write(path, errno);
    const std::string block =
        fmt::format("{}{}{}", last == '\n' ? "" : "\n", text, text.ends_with('\n') ? "" : "\n");
    if (write_all(file.number(), block)) return;
    const int error = errno;
    // if this fails too, the first error is the one to report
    [[maybe_unused]] const int removed = ::ftruncate(file.number(), before.st_size);
    fail_write(path, error);
  });
}

FileSet::~FileSet() {
  // in reverse order, so that folders are empty when removed; failures here cannot be reported
  for (auto it = undo_.rbegin(); it != undo_.rend(); ++it) {
    try {
      if (it->before)
        it->before->move_to(it->path);
      else
        ::remove(it->path.c_str());
    } catch (const Error&) {
    }
  }
}

void FileSet::make_folder(const fs::path& folder, const fs::path& file) {
  struct stat status;
  if (folder.empty() || ::stat(folder.c_str(), &status) == 0) return;
  make_folder(folder.parent_path(), file);
  if (::mkdir(folder.c_str(), 0777) == 0)
    undo_.push_back({folder, nullptr});
  else if (errno != EEXIST)
    fail_write(file, errno);
}

void FileSet::write(const fs::path& path, std::string_view text) {
  make_folder(path.parent_path(), path);
  struct stat status;
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists) {
    write_file(path, text);
    // a dangling link is kept
    undo_.push_back({fs::weakly_canonical(path), nullptr});
    return;
  }
  const std::string old = read_bytes(path);
  if (old == text) return;
  const fs::path target = fs::weakly_canonical(path);
  auto before = std::make_unique<Draft>(target, old, status.st_mode & 0777);
  ::chmod(before->path().c_str(), status.st_mode & 0777);
  write_file(path, text);
  undo_.push_back({target, std::move(before)});
}

}  // namespace clench
