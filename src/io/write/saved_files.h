// Files that a saved world refers to: their names in it, their contents, and the new files written
// next to it.
#pragma once
#include <map>
#include <set>

#include "clench/base/file.h"
#include "clench/io/text/file_cache.h"
#include "clench/io/text/write_options.h"

namespace clench {

class SavedFiles {
 public:
  /// path  file of the world
  SavedFiles(const std::filesystem::path& path, const WriteOptions& options);

  /// The name of a file as written in the world. Reading it with the same root finds exactly this
  /// file.
  std::string name(const std::string& file) const;
  /// The same for a robot's file; for a robot of a scene, "scene.xml#arm".
  std::string name(const RobotSpec& robot) const;
  /// The file relative to the root if it lies below the root; otherwise empty.
  std::string below_root(const std::string& file) const;
  const std::filesystem::path& root() const { return root_; }  ///< absolute, or empty
  /// folder of the world, absolute
  const std::filesystem::path& folder() const { return folder_; }

  /// The body as read again from its file; null if it has no file. Null with a warning if the file
  /// is missing or holds another surface.
  const BodySpec* again(const BodySpec& body);
  /// throws Error  "robot 'DLR' cannot be saved: ..."
  const RobotSpec& again(const RobotSpec& robot);

  /// Writes the body's surface as ball.off.   returns  its path; empty if it has no surface
  std::filesystem::path write_surface(const BodySpec& body);
  /// Writes the body as ball.xml, and its surface as ball.off next to it.   returns  the path of
  /// ball.xml
  std::filesystem::path write_body(const BodySpec& body);
  /// Writes files of the same name with different endings into a folder used only by this world,
  /// w_files/1a2b3c4d. The folder is named by a hash of the contents, so that files of other worlds
  /// are never overwritten.
  /// returns  the path of the first
  struct Beside {
    std::string ending, text;
  };
  std::filesystem::path write_beside(const std::string& name, const std::vector<Beside>& files);
  /// Keeps the files that were written. Without this call they are deleted again: for worlds that
  /// cannot be saved.
  void keep() { beside_.keep(); }

  const Diagnostics& diagnostics() const { return diagnostics_; }
  /// Warns if the robot was read with folders given by the caller: only .lua stores them.
  void warn_of_folders(const RobotSpec& robot) const;

 private:
  bool finds(const std::string& name, const std::string& file) const;
  void check_within(const std::string& file) const;

  std::filesystem::path path_, folder_, root_;
  ReadOptions reading_;  // options for reading files again
  FileCache cache_;
  Diagnostics diagnostics_;
  std::map<std::string, RobotSpec> given_;  // by name: robots that were read with folders
  std::set<std::string> warned_;
  FileSet beside_;
};

/// The elements of an XML body, one per line, each indented by `indent`.
std::string body_elements(const BodySpec& body, const std::string& surface,
                          const std::string& indent);
/// A complete XML body; `surface` is the name of its .off file, empty if it has none.
std::string body_xml_text(const BodySpec& body, const std::string& surface);

}  // namespace clench
