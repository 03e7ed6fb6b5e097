#include "clench/io/read/read.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "clench/base/text.h"
#include "clench/io/graspit/graspit_readers.h"
#include "clench/io/graspit/robot_files.h"
#include "clench/io/mjcf/mjcf.h"
#include "clench/io/read/load.h"
#include "clench/io/read/tree_files.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/file_kind.h"
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
    BodySpec body = FileCache(options, all_formats).body(find_file(path.string(), "", options));
    body.source = path.generic_string();
    return body;
  });
}

RobotSpec read_robot(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  return of_file([&] {
    RobotSpec robot =
        FileCache(options, all_formats).robot(find_file(path.string(), "", options), options.body);
    robot.source = path.generic_string();
    read_chosen_files(robot, options);
    return robot;
  });
}

/// A world that contains only this robot or body.
static WorldSpec around(RobotSpec robot) {
  WorldSpec world;
  world.robots.push_back({std::move(robot), {}, {}, {}});
  world.order.push_back({WorldEntry::Kind::robot, 0});
  return world;
}

static WorldSpec around(BodySpec body) {
  WorldSpec world;
  world.bodies.push_back({std::move(body), Role::object, {}});
  world.order.push_back({WorldEntry::Kind::body, 0});
  return world;
}

static WorldSpec world_of(const std::filesystem::path& path, FileCache& cache) {
  const FileKind kind = file_kind(path);
  if (!cache.options().body.empty()) {
    if (kind != FileKind::robot)
      fail("{}: body: expected a scene of MJCF, got another file", path.filename().string());
    return around(read_robot(path, cache.options()));
  }
  if (kind == FileKind::robot && is_scene(path)) {
    WorldSpec world = read_world_mjcf(path, cache);
    for (PlacedRobot& placed : world.robots) finish_robot(placed.robot, path, cache);
    return world;
  }
  if (kind == FileKind::robot) {
    RobotSpec robot = cache.robot(path);
    read_chosen_files(robot, cache.options());
    return around(std::move(robot));
  }
  if (kind == FileKind::body) return around(cache.body(path));
  if (kind != FileKind::world)
    fail("{}: expected a world, a robot or a body, got {}", path.filename().string(),
         kind_name(kind));
  if (ending_of(path) == ".lua")
    fail("{}: expected a world, a robot or a body, got a script", path.filename().string());
  return ending_of(path) == ".wld" ? read_world_wld(path, cache) : read_world_xml(path, cache);
}

WorldSpec read_world(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  return of_file([&] {
    FileCache cache(options, all_formats);
    const auto found = find_file(path.string(), "", options);
    WorldSpec world = world_of(found, cache);
    std::set<std::pair<std::string, const Shape*>> told;  // each repeated body is reported once
    std::vector<const BodySpec*> objects, obstacles;
    for (const PlacedBody& placed : world.bodies) {
      const std::string& file = placed.body.file.empty() ? placed.body.name : placed.body.file;
      if (!told.emplace(file, placed.body.shape.get()).second) continue;
      if (placed.role == Role::obstacle) {
        obstacles.push_back(&placed.body);
      } else {
        objects.push_back(&placed.body);
        check_plausible_object(
            placed.body, Place(found.filename().string()).of("'{}'", excerpt(placed.body.name)),
            options.diagnostics);
      }
    }
    tell_assumed(objects, Place(found.filename().string()), options.diagnostics, obstacles);
    world.source = path.generic_string();
    return world;
  });
}

}  // namespace clench
