// An Inventor or VRML file of any bytes, as a body and as a planner's primitives, with files beside it
// that it may include, itself among them: a spec or an Error.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "io/inventor_primitives.h"
#include "io/read.h"

namespace fs = std::filesystem;

static void write(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary)
      .write(text.data(), static_cast<std::streamsize>(text.size()));
}

// files are looked for in the folder above, too, so that it is ours
static const fs::path& folder() {
  static const fs::path made = [] {
    const fs::path path =
        fs::temp_directory_path() / fmt::format("clench_fuzz_{}", getpid()) / "in";
    fs::create_directories(path);
    write(path / "box.iv", "#Inventor V2.1 ascii\nCube { }\n");
    write(path / "part.wrl", "#VRML V2.0 utf8\nShape { geometry Box { } }\n");
    return path;
  }();
  return made;
}

template <class Read>
static void check(const fs::path& path, Read read) {
  try {
    read(path, clench::ReadOptions{});
  } catch (const clench::Error& error) {
    // a sentence names its file
    if (!std::string(error.what()).starts_with("fuzz.")) std::abort();
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view format = FORMAT;
  const fs::path path = folder() / (format == "wrl" ? "fuzz.wrl" : "fuzz.iv");
  write(path, {reinterpret_cast<const char*>(data), size});
  if (format == "prim")
    check(path, clench::read_primitives);
  else
    check(path, clench::read_body);
  return 0;
}
