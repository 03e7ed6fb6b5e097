// Options for reading files: search paths, receivers of diagnostics, and defaults for properties
// that files leave open.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "clench/base/diagnostic.h"
#include "clench/base/progress.h"
#include "clench/math/pose.h"

namespace clench {

struct ReadOptions {
  /// root for relative names, searched after the folder of the referring file
  std::filesystem::path root = {};
  /// robots: files to read instead of those named in the robot's file; empty: none
  std::string eigengrasps = {}, virtual_contacts = {};
  /// receives unused, unspecified, invalid and suspicious contents of files
  Diagnostics diagnostics = {};
  /// geometry files: length of their unit, > 0 [m]; absent: as given by the format or the file,
  /// otherwise silent_mesh_unit
  std::optional<double> mesh_scale = {};
  /// length of the unit of mesh files that do not specify one, > 0 [m]; absent: guessed by size
  std::optional<double> silent_mesh_unit = {};
  /// folder for names in a file, searched after the file's own folder and before the root
  std::filesystem::path folder = {};
  /// folder searched last for names given by the user, models/... and worlds/...; empty: none
  std::filesystem::path home = {};
  /// only files below this folder are read, with links resolved; empty: no restriction
  std::filesystem::path confine = {};
  /// folders of the packages that URDF files name: by name; under "" for any of them
  std::map<std::string, std::filesystem::path> packages = {};
  /// closing directions of DOFs, by name or number from 1: 1 up, -1 down, 0 not; the others are
  /// taken from the file, otherwise guessed
  std::map<std::string, double> closing = {};
  /// the same by number, from 1; needed if names are digits, because then a number is not taken as
  /// a name
  std::map<int, double> closing_by_number = {};
  /// scenes: the root body of the robot's joint tree; empty: the only robot of the file
  std::string body = {};
  /// approach frame in the base; absent: as given by the file, otherwise guessed
  std::optional<Pose> approach = {};
  /// .dae .gltf .glb: if true, the file's up axis is turned to z. (URDF uses the axes unchanged.)
  bool turn_mesh_up = true;
  /// receives the progress for each file; if it asks to stop, readers throw Stopped
  Progress progress = {};

  /// The same options, but names are relative to the folder of their file alone.
  ReadOptions beside_only() const;
};

/// The same options, but everything reported as a warning, repair, loss or suspicion is thrown as
/// an error. Notes are received as before.
ReadOptions strict(ReadOptions options);

}  // namespace clench
