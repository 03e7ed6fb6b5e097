// Files that make up a written robot: collected first, and written once all of them are known to be
// valid.
#pragma once
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "clench/base/file.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/io/write/write_world.h"

namespace clench {

class RobotFolder {
 public:
  /// path  file of the robot
  RobotFolder(const std::filesystem::path& path, const WriteOptions& options);

  const std::string& file() const { return file_; }  ///< name shown in messages
  const std::filesystem::path& path() const { return path_; }
  const Diagnostics& diagnostics() const { return diagnostics_; }
  /// "hand.urdf does not hold ..."
  void lost(const std::string& what) const { diagnostics_.lost(file_, what); }

  /// Triangles as HAND_files/PART.obj, in meters, with their colors if these differ. Equal meshes
  /// share a file.
  /// returns  the name relative to the robot's folder
  std::string mesh(const Mesh& mesh, const Appearance& looks, const std::string& part);
  /// eigen/HAND_urdf.egr, or .xml if amplitudes have limits; virtual/HAND_urdf.vgr;
  /// glove/HAND_urdf.txt.
  /// returns  the name relative to the robot's folder
  std::string eigengrasps(const EigengraspSet& set);
  std::string virtual_contacts(const VirtualContactSet& set);
  std::string glove(const GloveCalibration& glove);

  /// Writes the files collected so far.   throws Error if a file cannot be written
  void write_parts();
  /// Writes all files, the robot's main file last.   throws Error if one cannot be written; then
  /// none is
  void write(const std::string& text);

 private:
  std::string add(const std::string& folder, const std::string& part, const std::string& ending,
                  const std::string& text);
  std::string named_file(const std::string& folder, const std::string& ending) const;

  std::filesystem::path path_;
  std::string file_;
  std::string stem_, own_;  // stem of the file's name; stem and ending
  Diagnostics diagnostics_;
  std::filesystem::path confine_;
  std::map<std::string, std::string> texts_;  // file name relative to the robot's folder -> text
  std::map<std::string, std::string> names_;  // by folder, ending and text
  FileSet written_;
};

/// A color component clamped to 0..1, as files hold it; 0 for NaN.
inline float within_one(float share) { return share > 0 ? std::min(share, 1.0f) : 0.0f; }

/// Name of a part: the stem of its file, or its name without the robot's name.
std::string part_name(const BodySpec& body, const RobotSpec& robot);

}  // namespace clench
