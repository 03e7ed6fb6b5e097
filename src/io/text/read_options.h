// What a call that reads files is told: where to look, whom to tell, what to make of what files
// leave open.
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
  /// where relative names are looked up after the referring file's folder
  std::filesystem::path root = {};
  /// robots: files to read in place of those that theirs names; empty: none
  std::string eigengrasps = {}, virtual_contacts = {};
  /// receives what files contain and is not used, leave open, have wrong, and what looks wrong
  Diagnostics diagnostics = {};
  /// geometry files: length of their unit, > 0 [m]; absent: what the format or the file says, else
  /// silent_mesh_unit
  std::optional<double> mesh_scale = {};
  /// length of the unit of mesh files that say nothing of it, > 0 [m]; absent: guessed by size
  std::optional<double> silent_mesh_unit = {};
  /// where names in a file are looked up after the file's own folder, before the root
  std::filesystem::path folder = {};
  /// where names that a user gives, models/... and worlds/..., are looked up last; empty: nowhere
  std::filesystem::path home = {};
  /// nothing is read that does not lie below this folder, links followed; empty: anything may be
  std::filesystem::path confine = {};
  /// where the packages lie that URDF files name: by name; under "" any of them
  std::map<std::string, std::filesystem::path> packages = {};
  /// how DOFs close, by name or number from 1: 1 up, -1 down, 0 not; the
  /// rest is as the file says, else guessed
  std::map<std::string, double> closing = {};
  /// the same, from 1; where names are digits a number is no name
  std::map<int, double> closing_by_number = {};
  /// of a scene: the body that the robot's tree of joints begins with; empty: the file's one robot
  std::string body = {};
  /// approach frame in the base; absent: what the file says, else guessed
  std::optional<Pose> approach = {};
  /// .dae .gltf .glb: turn what the file calls up to z? (A URDF takes the axes as they stand.)
  bool turn_mesh_up = true;
  /// told of each file; what reads it throws Stopped
  Progress progress = {};

  /// As these, but names count from the folder of their file alone.
  ReadOptions beside_only() const;
};

/// The same, but what would be warned of is thrown: nothing is repaired, left out or suspicious.
/// Notes are received as before.
ReadOptions strict(ReadOptions options);

}  // namespace clench
