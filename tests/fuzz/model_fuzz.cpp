// A robot, body or world of arbitrary bytes, with small files around it that it may name, is a spec
// or an Error. The ending of a file or its outermost element decides which of the three it is.
#include "clench/io/text/xml.h"
#include "fuzz_files.h"

using namespace clench;
using namespace clench::fuzz;

static const fs::path& folder() {
  static const fs::path made = [] {
    const fs::path path = new_folder();
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
  const std::string text(text_of(data, size));
  const fs::path path = folder() / "fuzz." FORMAT;
  write(path, text);
  const std::string_view format = FORMAT;
  const std::string_view root = xml_root_name(text);
  if (format == "wld" || (format == "xml" && root == "world"))
    check(path, read_world);
  else if (format == "cfg" || (format == "xml" && root == "robot"))
    check(path, read_robot);
  else
    check(path, read_body);
  return 0;
}
