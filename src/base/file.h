// Files read and written. What the system refuses is told with its reason: "Permission denied".
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clench {

/// The system's words for an error number: "No space left on device".
std::string system_reason(int error);

/// A whole file as it stands.
/// throws Error when it does not exist, is no regular file, cannot be read or is larger than 1 GB
std::string read_bytes(const std::filesystem::path& path);
/// At most the first `count` bytes.   throws as read_bytes, but for its size
std::string read_start(const std::filesystem::path& path, size_t count);

/// A file beside another, of a name that nobody else has; gone at the end.
class Draft {
 public:
  /// "out/w.wld" gives "out/.w.1f2e3d4c5b6a7988.wld", on the disk when this returns.
  /// throws Error  "out/w.wld: the file cannot be written: Permission denied"
  /// `mode`: permissions, of which the user's mask takes some
  Draft(const std::filesystem::path& beside, std::string_view text, unsigned mode = 0666);
  ~Draft();
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Takes that file's place.   throws Error as the constructor
  void move_to(const std::filesystem::path& target);

 private:
  std::filesystem::path path_;
};

/// throws Error  "out/a.vgr: the file cannot be written: no such folder: out"
void check_folder_of(const std::filesystem::path& file);

/// Writes beside the file and then takes its place: whatever goes wrong, the old file stays as it
/// was. A link is followed; a file keeps its permissions, and one that must not be written is not.
/// throws Error  "out/a.vgr: the file cannot be written: Permission denied"
void write_file(const std::filesystem::path& path, std::string_view text);

/// Checks that write_file could write there, by a draft that is removed: no file is changed.
/// throws Error as write_file
void check_writable(const std::filesystem::path& path);

/// Appends a text that begins on a new line and ends with the end of a line, in one call of the
/// system: a process that is killed leaves all of it or nothing. Creates the file if there is none.
/// If only a part fits on the disk, that part is removed again.
/// throws Error as write_file
void append_file(const std::filesystem::path& path, std::string_view text);

/// Files that belong together: all stay, or none. Each is there as soon as it is written.
class FileSet {
 public:
  FileSet() = default;
  /// unless they were kept: new files and folders go, older files are as they were
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Makes the folders that lack.   throws Error as write_file
  void write(const std::filesystem::path& path, std::string_view text);
  void keep() { undo_.clear(); }

 private:
  void make_folder(const std::filesystem::path& folder, const std::filesystem::path& file);

  struct Undo {
    std::filesystem::path path;
    std::unique_ptr<Draft> before;  // what stood there, if anything did
  };
  std::vector<Undo> undo_;
};

}  // namespace clench
