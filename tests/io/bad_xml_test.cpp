// Every file of tests/data/bad/xml/ is refused with the sentence that stands beside it. What it is
// meant to be begins its name: body, robot or world.
#include <algorithm>

#include "base/text.h"
#include "io/read.h"

using namespace clench;
namespace fs = std::filesystem;

static std::vector<fs::path> bad_files(const std::string& kind) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator("tests/data/bad/xml")) {
    const fs::path path = entry.path();
    if (path.extension() == ".txt" && path.stem().string().starts_with(kind + "_"))
      out.push_back(fs::path(path).replace_extension(".xml"));
  }
  std::sort(out.begin(), out.end());
  return out;
}

template <class Read>
static void check_kind(const std::string& kind, Read read) {
  const auto files = bad_files(kind);
  REQUIRE(files.size() > 10);
  for (const auto& file : files) {
    const std::string sentence(trim(read_text(fs::path(file).replace_extension(".txt"))));
    INFO(file.string());
    CHECK_THROWS_WITH_AS(read(file), sentence.c_str(), Error);
  }
}

TEST_CASE("a malformed XML body is told by file, line, wanted and got") {
  check_kind("body", [](const fs::path& p) { read_body(p); });
}
TEST_CASE("a malformed XML robot is told by file, line, wanted and got") {
  check_kind("robot", [](const fs::path& p) { read_robot(p); });
}
TEST_CASE("a malformed XML world is told by file, line, wanted and got") {
  check_kind("world", [](const fs::path& p) { read_world(p); });
}
