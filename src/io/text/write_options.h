// Options for writing files.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "clench/base/diagnostic.h"

namespace clench {

struct WriteOptions {
  /// names of files below this folder are written relative to it; names of other files relative to
  /// the written file's folder if they lie below that, otherwise absolute
  std::filesystem::path root = {};
  /// only files below this folder are read again for comparison, as in ReadOptions
  std::filesystem::path confine = {};
  /// receives properties that the format cannot represent
  Diagnostics diagnostics = {};
  /// called with the complete file under a temporary name in its folder, before it replaces an
  /// older file; if it throws, the older file is kept
  std::function<void(const std::filesystem::path&)> check = {};
  /// notes on a list of grasps: a JSON object; empty: none
  std::string notes = {};
  bool compress = false;  ///< compresses arrays in .npz; an error for other formats
};

}  // namespace clench
