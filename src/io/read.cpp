#include "io/read.h"

#include "base/text.h"
#include "io/library.h"

namespace clench {

static void check_options(const ReadOptions& options) {
  if (!(options.mesh_scale > 0) || !std::isfinite(options.mesh_scale))
    fail("read options: mesh_scale: wanted a length > 0 [m], got {}", options.mesh_scale);
}

BodySpec read_body(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  BodySpec body = Library(options).body(find_file(path.string(), "", options));
  body.source = path.generic_string();
  return body;
}

RobotSpec read_robot(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  RobotSpec robot = Library(options).robot(find_file(path.string(), "", options));
  robot.source = path.generic_string();
  return robot;
}

}  // namespace clench
