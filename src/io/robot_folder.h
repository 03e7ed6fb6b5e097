// The files that a written robot consists of: gathered first, and written when all is known to fit.
#pragma once
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "clench/base/file.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/write_world.h"

namespace clench {

class RobotFolder {
 public:
  /// `path` is the robot's file
  RobotFolder(const std::filesystem::path& path, const WriteOptions& options);

  const std::string& file() const { return file_; }  ///< name shown in sentences
  const std::filesystem::path& path() const { return path_; }
  const Diagnostics& diagnostics() const { return diagnostics_; }
  /// "hand.urdf does not hold ..."
  void lost(const std::string& what) const { diagnostics_.lost(file_, what); }

  /// Triangles as HAND_files/PART.obj, in meters, with their colors when these differ. Equal ones
  /// share a file.
  /// returns  the name from the robot's folder on
  std::string mesh(const Mesh& mesh, const Appearance& looks, const std::string& part);
  /// eigen/HAND_urdf.egr, or .xml where amplitudes have limits; virtual/HAND_urdf.vgr;
  /// glove/HAND_urdf.txt.
  /// returns  the name from the robot's folder on
  std::string eigengrasps(const EigengraspSet& set);
  std::string virtual_contacts(const VirtualContactSet& set);
  std::string glove(const GloveCalibration& glove);

  /// Writes what was gathered so far.   throws Error when a file cannot be written
  void write_parts();
  /// Writes all, the robot's own file last.   throws Error when one cannot be written; then none is
  void write(const std::string& text);

 private:
  std::string add(const std::string& folder, const std::string& part, const std::string& ending,
                  const std::string& text);
  std::string named_file(const std::string& folder, const std::string& ending) const;

  std::filesystem::path path_;
  std::string file_;
  std::string stem_, own_;  // of its name; the same with its ending
  Diagnostics diagnostics_;
  std::filesystem::path confine_;
  std::map<std::string, std::string> texts_;  // name in the folder, from the robot's on, to text
  std::map<std::string, std::string> names_;  // by folder, ending and text
  FileSet written_;
};

/// A color's share brought within 0..1, as files hold it; 0 for what is no number.
inline float within_one(float share) { return share > 0 ? std::min(share, 1.0f) : 0.0f; }

/// What a part is called: the stem of its file, or its name without that of the robot.
std::string part_name(const BodySpec& body, const RobotSpec& robot);

}  // namespace clench
