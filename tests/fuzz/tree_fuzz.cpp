// A URDF or MJCF robot of any bytes is a robot that check_robot takes, or an Error that names the file.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "io/read.h"

namespace fs = std::filesystem;

static void write(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary)
      .write(text.data(), static_cast<std::streamsize>(text.size()));
}

// the files that robots name
static const fs::path& folder() {
  static const fs::path made = [] {
    const fs::path path = fs::temp_directory_path() / fmt::format("clench_fuzz_{}", getpid());
    fs::create_directories(path / "parts");
    for (const char* name : {"finger.obj", "parts/finger.obj"})
      write(path / name,
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    write(path / "defaults.xml",
          "<mujoco><default><default class='hand'><joint axis='1 0 0'/></default></default>"
          "</mujoco>");
    return path;
  }();
  return made;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fs::path path = folder() / "fuzz." FORMAT;
  write(path, {reinterpret_cast<const char*>(data), size});
  clench::ReadOptions options;
  options.packages[""] = folder();
  try {
    clench::check_robot(clench::read_robot(path, options));
  } catch (const clench::Error& error) {
    const std::string sentence = error.what();
    if (!sentence.starts_with("fuzz." FORMAT) && !sentence.starts_with("defaults.xml"))
      std::abort();
  }
  return 0;
}
