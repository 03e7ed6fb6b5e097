#include "io/read.h"

#include "base/text.h"
#include "io/library.h"
#include "io/world_wld.h"

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

WorldSpec read_world(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  Library library(options);
  const auto found = find_file(path.string(), "", options);
  const std::string extension = lower_case(found.extension().string());
  if (extension != ".wld")
    fail("{}: wanted a world from .wld, got {}", found.filename().string(), in_quotes(extension));
  WorldSpec world = read_world_wld(found, library);
  world.source = path.generic_string();
  return world;
}

}  // namespace clench
