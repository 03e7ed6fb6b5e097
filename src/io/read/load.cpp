#include "clench/io/read/load.h"

#include "clench/base/text.h"
#include "clench/io/graspit/body_xml.h"
#include "clench/io/graspit/graspit_readers.h"
#include "clench/io/inventor/inventor.h"
#include "clench/io/inventor/inventor_params.h"
#include "clench/io/inventor/read_geometry.h"
#include "clench/io/mesh/mesh_files.h"
#include "clench/io/read/tree_files.h"
#include "clench/io/text/repair_names.h"
#include "clench/io/tree/closing_choice.h"
#include "clench/spec/assumed.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace fs = std::filesystem;

static BodySpec load_body(const fs::path& path, FileCache& cache) {
  const std::string file = path.filename().string();
  const ReadOptions& options = cache.options();
  BodySpec body;
  if (ending_of(path) == ".xml") {
    body = read_body_xml(path, cache);
  } else if (geometry_format(ending_of(path)) == GeometryFormat::none) {
    fail("{}: expected a body from {}, got {}", file, one_of(body_endings()),
         in_quotes(ending_of(path)));
  } else {
    Geometry geometry;
    if (is_inventor(path)) {
      const std::string text = read_text(path);
      read_inventor_params(text, file, options, body);
      geometry = read_geometry(path, options, GeometryFormat::inventor, &text);
    } else {
      geometry = read_geometry(path, options);
    }
    body.appearance = std::move(geometry.appearance);
    body.mesh_report = std::move(geometry.report);
    if (geometry.mesh.triangles.empty())
      options.diagnostics.suspected(Place(file),
                                    "no surface: the body is a frame, which touches nothing");
    else
      body.shape = Shape::make(std::move(geometry.mesh), file, cache.options().progress);
  }
  body.name = path.stem().string();
  repair_names(body, Place(file), options);
  body.source = path.generic_string();
  body.file = absolute_name(path);
  return body;
}

void finish_robot(RobotSpec& robot, const fs::path& path, FileCache& cache) {
  robot.file = absolute_name(path);
  const ReadOptions& options = cache.options();
  const Place file(path.filename().string());
  check_plausible(robot, file, options.diagnostics);
  std::vector<const BodySpec*> parts = {&robot.base};
  for (const LinkSpec& link : robot.links) parts.push_back(&link.body);
  tell_assumed(parts, file, options.diagnostics);
  if (!is_robot_tree(path)) choose_closing(robot, path.filename().string(), options);
  if (!robot.X_BA) {
    // a scene may have several robots
    const Place robot_place = is_scene(path) ? file.of(in_quotes(robot.name)) : file;
    options.diagnostics.note(
        robot_place,
        "no approach direction is given; it is the z axis of its base, from its origin");
  }
  if (!options.folder.empty()) robot.files.folder = absolute_name(options.folder);
  for (const auto& [name, folder] : options.packages)
    robot.files.packages[name] = absolute_name(folder);
}

static RobotSpec load_robot(const fs::path& path, const std::string& body, FileCache& cache) {
  const std::string extension = ending_of(path);
  RobotSpec robot;
  if (!body.empty() && !is_scene(path))
    fail("{}: body: expected a scene of MJCF, got another file", path.filename().string());
  if (extension == ".cfg")
    robot = read_robot_cfg(path, cache);
  else if (is_robot_tree(path))
    robot = read_robot_tree(path, body, cache);
  else if (extension == ".xml")
    robot = read_robot_xml(path, cache);
  else
    fail("{}: expected a robot from .cfg, .xml, .urdf or .mjcf, got {}", path.filename().string(),
         in_quotes(extension));
  finish_robot(robot, path, cache);
  return robot;
}

const Loaders all_formats = {load_body, load_robot};

}  // namespace clench
