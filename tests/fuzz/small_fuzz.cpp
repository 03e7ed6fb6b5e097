// The small files for hands and planners, of arbitrary bytes: a value or an Error. If two kinds
// have the same ending, both readers are tried.
#include "clench/io/grasp_lines.h"
#include "clench/io/graspit/eigengrasps.h"
#include "clench/io/graspit/glove_files.h"
#include "clench/io/graspit/grasp_lists.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "fuzz_files.h"

using namespace clench;
using namespace clench::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const fs::path path = new_folder() / "fuzz." FORMAT;
  write(path, text_of(data, size));
  const std::string_view format = FORMAT;
  if (format == "egr") {
    check(path, read_eigengrasps);
  } else if (format == "vgr") {
    check(path, read_virtual_contacts);
  } else if (format == "con") {
    check(path, read_object_contacts);
  } else if (format == "lst") {
    check(path, read_pregrasps);
    check(path, read_planned_grasps);
  } else if (format == "jsonl") {
    check(path, read_grasps);
  } else {
    check(path, read_glove_calibration);
    check(path, read_glove_poses);
  }
  return 0;
}
