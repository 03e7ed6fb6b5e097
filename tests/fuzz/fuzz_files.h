// What the programs that fuzz readers share: a folder of files to name, and what they ask of an
// Error.
#pragma once
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "clench/base/error.h"
#include "clench/io/read.h"

namespace clench::fuzz {

namespace fs = std::filesystem;

inline void write(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary)
      .write(text.data(), static_cast<std::streamsize>(text.size()));
}

inline std::string_view text_of(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// of this process alone; readers look for files in the folder above, too, so that it is ours
inline fs::path new_folder() {
  fs::path path = fs::temp_directory_path() / fmt::format("clench_fuzz_{}", getpid()) / "in";
  fs::create_directories(path);
  return path;
}

/// Reads `path`, or meets an Error whose sentence names it, or the file `beside` it.
template <class Read>
void check(const fs::path& path, Read read, std::string_view beside = {}) {
  try {
    read(path, ReadOptions{});
  } catch (const Error& error) {
    const std::string_view sentence = error.what();
    if (sentence.starts_with(path.filename().string())) return;
    if (beside.empty() || !sentence.starts_with(beside)) std::abort();
  }
}

}  // namespace clench::fuzz
