// The files that a saved world names: how they are called in it, what they hold, and those that are
// written beside it.
#pragma once
#include <map>
#include <set>

#include "clench/base/file.h"
#include "clench/io/text/file_cache.h"
#include "clench/io/text/write_options.h"

namespace clench {

class SavedFiles {
 public:
  /// `path` is the world's
  SavedFiles(const std::filesystem::path& path, const WriteOptions& options);

  /// A file as the world names it. Reading it with the same root finds that very file.
  std::string name(const std::string& file) const;
  /// The same of a robot's file; of one of a scene's, "scene.xml#arm".
  std::string name(const RobotSpec& robot) const;
  /// The file from the root on, when it lies below that; else empty.
  std::string below_root(const std::string& file) const;
  const std::filesystem::path& root() const { return root_; }      ///< absolute, or empty
  const std::filesystem::path& folder() const { return folder_; }  ///< of the world, absolute

  /// What the body's file gives when it is read again; null when it has none, or it is gone or
  /// holds another surface, which is warned of.
  const BodySpec* again(const BodySpec& body);
  /// throws Error  "robot 'DLR' cannot be saved: ..."
  const RobotSpec& again(const RobotSpec& robot);

  /// Writes the body's surface as ball.off.   returns  its path; empty when it has none
  std::filesystem::path write_surface(const BodySpec& body);
  /// Writes the body as ball.xml, and ball.off beside.   returns  the path of the first
  std::filesystem::path write_body(const BodySpec& body);
  /// Writes files of one name that differ by their endings into a folder of the world's own,
  /// w_files/1a2b3c4d, which is called after what they hold: no other world's are touched.
  /// returns  the path of the first
  struct Beside {
    std::string ending, text;
  };
  std::filesystem::path write_beside(const std::string& name, const std::vector<Beside>& files);
  /// Else nothing of what was written beside stays: for a world that cannot be saved.
  void keep() { beside_.keep(); }

  const Diagnostics& diagnostics() const { return diagnostics_; }
  /// Warns of the folders that the robot was read with, if there are any: only .lua holds them.
  void warn_of_folders(const RobotSpec& robot) const;

 private:
  bool finds(const std::string& name, const std::string& file) const;
  void check_within(const std::string& file) const;

  std::filesystem::path path_, folder_, root_;
  ReadOptions reading_;  // of what is read again
  FileCache cache_;
  Diagnostics diagnostics_;
  std::map<std::string, RobotSpec> given_;  // robots whose reading was given folders, by name
  std::set<std::string> warned_;
  FileSet beside_;
};

/// The elements of an XML body, a line each, `indent` before them.
std::string body_elements(const BodySpec& body, const std::string& surface,
                          const std::string& indent);
/// An XML body whole; `surface` is how it names its .off, empty when it has none.
std::string body_xml_text(const BodySpec& body, const std::string& surface);

}  // namespace clench
