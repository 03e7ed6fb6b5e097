#include "clench/io/read.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "clench/base/text.h"
#include "clench/io/graspit/robot_files.h"
#include "clench/io/graspit/world_wld.h"
#include "clench/io/graspit/world_xml.h"
#include "clench/io/load.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/tree_files.h"
#include "clench/spec/assumed.h"
#include "clench/spec/plausibility.h"

namespace clench {

static void check_options(const ReadOptions& options) {
  const auto check = [](const char* name, const std::optional<double>& length) {
    if (length && (!(*length > 0) || !std::isfinite(*length)))
      fail("read options: {}: expected a length > 0 [m], got {}", name, *length);
  };
  check("mesh_scale", options.mesh_scale);
  check("silent_mesh_unit", options.silent_mesh_unit);
}

BodySpec read_body(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  return of_file([&] {
    BodySpec body = Library(options, all_formats).body(find_file(path.string(), "", options));
    body.source = path.generic_string();
    return body;
  });
}

RobotSpec read_robot(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  return of_file([&] {
    RobotSpec robot = Library(options, all_formats).robot(find_file(path.string(), "", options));
    robot.source = path.generic_string();
    read_chosen_files(robot, options);
    return robot;
  });
}

WorldSpec read_world(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  return of_file([&] {
    Library library(options, all_formats);
    const auto found = find_file(path.string(), "", options);
    const std::string extension = lower_case(found.extension().string());
    WorldSpec world;
    if (is_robot_tree(found))
      fail("{}: expected a world, got a robot; world:add_robot loads it",
           found.filename().string());
    if (extension == ".wld")
      world = read_world_wld(found, library);
    else if (extension == ".xml")
      world = read_world_xml(found, library);
    else
      fail("{}: expected a world from .wld or .xml, got {}", found.filename().string(),
           in_quotes(extension));
    std::set<std::string> told;  // of what stands there more than once, one
    std::vector<const BodySpec*> objects;
    for (const PlacedBody& placed : world.bodies)
      if (placed.role == Role::object && told.insert(placed.body.file).second) {
        objects.push_back(&placed.body);
        check_plausible_object(
            placed.body,
            fmt::format("{}: '{}'", found.filename().string(), excerpt(placed.body.name)),
            options.listeners());
      }
    tell_assumed(objects, found.filename().string(), options.listeners());
    world.source = path.generic_string();
    return world;
  });
}

}  // namespace clench
