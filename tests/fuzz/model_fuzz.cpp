// A robot, body or world of any bytes, and small files around it that it may name, is a spec or an
// Error. Which of the three a file is meant to be, its ending says, or its outermost element.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "io/read.h"
#include "io/xml.h"

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
    fs::create_directories(path / "iv");
    for (const char* name : {"box.iv", "iv/box.iv", "part.iv", "iv/part.iv"})
      write(path / name, "#Inventor V2.1 ascii\nCube { }\n");
    write(path / "hand.cfg",
          "Hand\nbox.iv\n1\nb 1 1e9 1e9 1e7 20 0.5\n1\n1\n1\nt 0 0 0\nd0 0 10 0 -10 "
          "90\nRevolute\nbox.iv 0\n");
    return path;
  }();
  return made;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const fs::path path = folder() / "fuzz." FORMAT;
  write(path, text);
  const std::string_view format = FORMAT, root = clench::xml_root_name(text);
  try {
    if (format == "wld" || (format == "xml" && root == "world"))
      clench::read_world(path);
    else if (format == "cfg" || (format == "xml" && root == "robot"))
      clench::read_robot(path);
    else
      clench::read_body(path);
  } catch (const clench::Error& error) {
    // a sentence names its file
    if (!std::string(error.what()).starts_with("fuzz." FORMAT)) std::abort();
  }
  return 0;
}
