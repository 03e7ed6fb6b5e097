// The small files around hands and planners, of any bytes: a value or an Error. Where two kinds have
// one ending, both readers are tried.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "io/eigengrasps.h"
#include "io/glove_files.h"
#include "io/grasp_lists.h"
#include "io/virtual_contacts.h"

namespace fs = std::filesystem;

template <class Reader>
static void check(const fs::path& path, Reader read) {
  try {
    read(path, clench::ReadOptions{});
  } catch (const clench::Error& error) {
    // a sentence names its file
    if (!std::string(error.what()).starts_with(path.filename().string())) std::abort();
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const fs::path path =
      fs::temp_directory_path() / fmt::format("clench_fuzz_{}." FORMAT, getpid());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const std::string_view format = FORMAT;
  if (format == "egr") {
    check(path, clench::read_eigengrasps);
  } else if (format == "vgr") {
    check(path, clench::read_virtual_contacts);
  } else if (format == "con") {
    check(path, clench::read_object_contacts);
  } else if (format == "lst") {
    check(path, clench::read_pregrasps);
    check(path, clench::read_planned_grasps);
  } else {
    check(path, clench::read_glove_calibration);
    check(path, clench::read_glove_poses);
  }
  return 0;
}
