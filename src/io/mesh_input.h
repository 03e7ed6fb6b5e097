// What every mesh reader is given.
#pragma once
#include <filesystem>
#include <string>

#include "io/read.h"

namespace clench {

struct MeshInput {
  const std::filesystem::path& path;  ///< its name is shown in errors; files it names lie beside it
  const std::string& bytes;           ///< what the file holds
  const ReadOptions& options;

  std::string file() const { return path.filename().string(); }
  void warn(const std::string& sentence) const {
    if (options.warn) options.warn(sentence);
  }
};

}  // namespace clench
