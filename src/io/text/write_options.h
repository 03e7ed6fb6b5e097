// What a call that writes files is told.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "clench/base/diagnostic.h"

namespace clench {

struct WriteOptions {
  /// names of files below it are written from there on; others from the file's own folder on where
  /// they lie below that, else absolute
  std::filesystem::path root = {};
  /// files that are read again are those below this folder, as in ReadOptions
  std::filesystem::path confine = {};
  /// receives what is not as the file would have it
  Diagnostics diagnostics = {};
  /// sees the whole file under another name in its folder, before it takes the place of an older
  /// one; what it throws keeps that one
  std::function<void(const std::filesystem::path&)> check = {};
  /// of a list of grasps as such: a JSON object; empty: none
  std::string notes = {};
  bool compress = false;  ///< of arrays in .npz; of other formats an error
};

}  // namespace clench
