// Files to specs: the only door. Each format has its own file behind it.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "spec/world_spec.h"

namespace clench {

struct ReadOptions {
  /// where relative names are looked up after the referring file's folder
  std::filesystem::path root;
  /// told of what a file contains and we do not use
  std::function<void(const std::string&)> warn = {};
  /// told of what a file leaves open and we guess
  std::function<void(const std::string&)> note = {};
  /// .obj .stl: length of the file's unit, > 0 [m]
  double mesh_scale = 1;
};

/// A body from .iv .wrl (millimetres), .obj .stl (metres, or mesh_scale), in any case.
/// throws Error  "flask.iv:31: ..." one sentence: place, subject, wanted, got
BodySpec read_body(const std::filesystem::path& path, const ReadOptions& options = {});

/// A robot from .cfg.
RobotSpec read_robot(const std::filesystem::path& path, const ReadOptions& options = {});

/// A world from .wld.
WorldSpec read_world(const std::filesystem::path& path, const ReadOptions& options = {});

/// Where `name`, as written in `referrer` (empty: given by the user), is found: beside the
/// referrer, below the root, below the referrer's parent folder. Back-slashes count as slashes, and
/// a name that differs only in case is found.
/// throws Error  "no such file: flsk.iv; did you mean 'flask.iv'?"  "wanted a file, got a folder: models"
std::filesystem::path find_file(const std::string& name, const std::filesystem::path& referrer,
                                const ReadOptions& options);

}  // namespace clench
