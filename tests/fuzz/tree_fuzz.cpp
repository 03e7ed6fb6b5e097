// A URDF or MJCF robot of arbitrary bytes is a robot that check_robot accepts, or an Error that
// names the file.
#include "clench/spec/check_robot.h"
#include "fuzz_files.h"

using namespace clench;
using namespace clench::fuzz;

// the files that robots name
static const fs::path& folder() {
  static const fs::path made = [] {
    const fs::path path = new_folder();
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

static void read_checked(const fs::path& path, ReadOptions options) {
  options.packages[""] = folder();
  check_robot(read_robot(path, options));
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fs::path path = folder() / "fuzz." FORMAT;
  write(path, text_of(data, size));
  check(path, read_checked, "defaults.xml");
  return 0;
}
