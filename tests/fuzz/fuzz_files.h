// Shared by the programs that fuzz readers: a folder for files, and the checks of an Error.
#pragma once
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "clench/base/error.h"
#include "clench/io/read/read.h"

namespace clench::fuzz {

namespace fs = std::filesystem;

inline void write(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary)
      .write(text.data(), static_cast<std::streamsize>(text.size()));
}

inline std::string_view text_of(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// a folder of this process only; readers also search the parent folder, which is therefore ours,
/// too
inline fs::path new_folder() {
  fs::path path = fs::temp_directory_path() / fmt::format("clench_fuzz_{}", getpid()) / "in";
  fs::create_directories(path);
  return path;
}

/// Reads `path`, or gets an Error whose message names it, or the file `beside` it.
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
