// Every file of tests/data/bad/xml/ is rejected with the message in the file next to it. The file
// name begins with its kind: body, robot or world.
#include "bad_files.h"
#include "clench/io/read/read.h"

using namespace clench;
using clench::test::check_bad_files;
namespace fs = std::filesystem;

TEST_CASE("a malformed XML body is told by file, line, expected and got") {
  check_bad_files("xml", "body_", ".xml", 10, [](const fs::path& p) { read_body(p); });
}
TEST_CASE("a malformed XML robot is told by file, line, expected and got") {
  check_bad_files("xml", "robot_", ".xml", 10, [](const fs::path& p) { read_robot(p); });
}
TEST_CASE("a malformed XML world is told by file, line, expected and got") {
  check_bad_files("xml", "world_", ".xml", 10, [](const fs::path& p) { read_world(p); });
}
