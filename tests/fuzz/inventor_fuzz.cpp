// An Inventor or VRML file of arbitrary bytes, as a body and as a planner's primitives, with files
// next to it that it may include, including itself: a spec or an Error.
#include "clench/io/graspit/inventor_primitives.h"
#include "fuzz_files.h"

using namespace clench;
using namespace clench::fuzz;

static const fs::path& folder() {
  static const fs::path made = [] {
    const fs::path path = new_folder();
    write(path / "box.iv", "#Inventor V2.1 ascii\nCube { }\n");
    write(path / "part.wrl", "#VRML V2.0 utf8\nShape { geometry Box { } }\n");
    return path;
  }();
  return made;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view format = FORMAT;
  const fs::path path = folder() / (format == "wrl" ? "fuzz.wrl" : "fuzz.iv");
  write(path, text_of(data, size));
  if (format == "prim")
    check(path, read_primitives);
  else
    check(path, read_body);
  return 0;
}
