// Reads and writes files. Errors state the system's reason: "Permission denied".
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clench {

/// The system's message for an error number: "No space left on device".
std::string system_reason(int error);

/// Complete contents of a file.
/// throws Error if it does not exist, is not a regular file, cannot be read or is larger than 1 GB
std::string read_bytes(const std::filesystem::path& path);
/// At most the first `count` bytes.
/// throws  as read_bytes, except for the size
std::string read_start(const std::filesystem::path& path, size_t count);

/// A temporary file next to another, with a unique name; deleted by the destructor.
class Draft {
 public:
  /// "out/w.wld" gives "out/.w.1f2e3d4c5b6a7988.wld", on the disk when this returns.
  /// throws Error  "out/w.wld: the file cannot be written: Permission denied"
  /// `mode`: permissions, reduced by the user's umask
  Draft(const std::filesystem::path& beside, std::string_view text, unsigned mode = 0666);
  ~Draft();
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Replaces the target by this file.
  /// throws  Error as the constructor
  void move_to(const std::filesystem::path& target);

 private:
  std::filesystem::path path_;
};

/// throws Error  "out/a.vgr: the file cannot be written: no such folder: out"
void check_folder_of(const std::filesystem::path& file);

/// Writes a temporary file and then replaces the target: after any failure the old file is
/// unchanged. Links are followed; a file keeps its permissions, and a read-only file is not
/// written.
/// throws Error  "out/a.vgr: the file cannot be written: Permission denied"
void write_file(const std::filesystem::path& path, std::string_view text);

/// Checks that write_file could write there, by a draft that is removed: no file is changed.
/// throws Error as write_file
void check_writable(const std::filesystem::path& path);

/// Appends a text that begins on a new line and ends with a line end, in one system call: if the
/// process is killed, the text is written completely or not at all. Creates the file if necessary.
/// If only a part fits on the disk, that part is removed again.
/// throws Error as write_file
void append_file(const std::filesystem::path& path, std::string_view text);

/// Files that belong together: all are kept, or none. Each exists as soon as it is written.
class FileSet {
 public:
  FileSet() = default;
  /// unless keep() was called: removes new files and folders, restores older files
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Creates missing folders.
  /// throws  Error as write_file
  void write(const std::filesystem::path& path, std::string_view text);
  void keep() { undo_.clear(); }

 private:
  void make_folder(const std::filesystem::path& folder, const std::filesystem::path& file);

  struct Undo {
    std::filesystem::path path;
    std::unique_ptr<Draft> before;  // the previous file, if there was one
  };
  std::vector<Undo> undo_;
};

}  // namespace clench
