// A list of grasps of arbitrary bytes, in each format of grasp lists, is a list or an Error.
#include "clench/io/grasp_files.h"
#include "fuzz_files.h"

using namespace clench;
using namespace clench::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const fs::path path = new_folder() / "fuzz." FORMAT;
  write(path, text_of(data, size));
  const std::string_view ending = FORMAT;
  // several programs write .yaml, .yml and .json: the content decides, and each reader is tried
  for (const char* format : {"", "isaac_grasp", "graspgen", "multigripper"})
    if (*format == '\0' || ending == "json" || ending == "yaml")
      check(path, [format](const fs::path& file) { return read_grasp_file(file, format); });
  return 0;
}
