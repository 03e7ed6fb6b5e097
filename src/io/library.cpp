#include "io/library.h"

#include "base/text.h"
#include "io/body_xml.h"
#include "io/closing_choice.h"
#include "io/inventor.h"
#include "io/inventor_params.h"
#include "io/mesh_files.h"
#include "io/repair_names.h"
#include "io/robot_cfg.h"
#include "io/robot_xml.h"
#include "io/tree_files.h"
#include "spec/plausibility.h"

namespace clench {

namespace fs = std::filesystem;

std::string absolute_name(const fs::path& path) {
  return fs::absolute(path).lexically_normal().generic_string();
}

Geometry read_geometry(const fs::path& path, const ReadOptions& options, GeometryFormat format,
                       const std::string* text) {
  if (format == GeometryFormat::none) format = geometry_format(ending_of(path));
  if (format == GeometryFormat::none)
    fail("{}: expected geometry from {}, got {}", path.filename().string(),
         one_of(geometry_endings()), in_quotes(ending_of(path)));
  if (format == GeometryFormat::inventor)
    return read_inventor(path, text ? *text : read_text(path), options);
  return read_mesh_file(path, options, format);
}

static BodySpec load_body(const fs::path& path, Library& library) {
  const std::string file = path.filename().string();
  const ReadOptions& options = library.options();
  BodySpec body;
  if (ending_of(path) == ".xml") {
    body = read_body_xml(path, library);
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
      options.suspected(file + ": no surface: the body is a frame, which touches nothing");
    else
      body.shape = Shape::make(std::move(geometry.mesh), file);
  }
  body.name = path.stem().string();
  repair_names(body, file, options);
  body.source = path.generic_string();
  body.file = absolute_name(path);
  return body;
}

static RobotSpec load_robot(const fs::path& path, Library& library) {
  const std::string extension = ending_of(path);
  RobotSpec robot;
  if (extension == ".cfg")
    robot = read_robot_cfg(path, library);
  else if (is_robot_tree(path))
    robot = read_robot_tree(path, library);
  else if (extension == ".xml")
    robot = read_robot_xml(path, library);
  else
    fail("{}: expected a robot from .cfg, .xml, .urdf or .mjcf, got {}", path.filename().string(),
         in_quotes(extension));
  robot.file = absolute_name(path);
  const ReadOptions& options = library.options();
  check_plausible(robot, path.filename().string(), options.listeners());
  if (!is_robot_tree(path)) choose_closing(robot, path.filename().string(), options);
  if (!options.folder.empty()) robot.files.folder = absolute_name(options.folder);
  for (const auto& [name, folder] : options.packages)
    robot.files.packages[name] = absolute_name(folder);
  return robot;
}

const BodySpec& Library::body(const fs::path& path) {
  auto found = bodies_.find(path);
  if (found == bodies_.end()) found = bodies_.emplace(path, load_body(path, *this)).first;
  return found->second;
}

const RobotSpec& Library::robot(const fs::path& path) {
  auto found = robots_.find(path);
  if (found == robots_.end()) found = robots_.emplace(path, load_robot(path, *this)).first;
  return found->second;
}

BodySpec Library::named_body(const std::string& name, const fs::path& referrer,
                             const std::string& place) {
  try {
    BodySpec out = body(find_model(name, referrer, ModelKind::body, place, options_));
    out.source = name;
    return out;
  } catch (const Error& error) {
    fail("{}: {}", place, error.what());
  }
}

RobotSpec Library::named_robot(const std::string& name, const fs::path& referrer,
                               const std::string& place) {
  try {
    RobotSpec out = robot(find_model(name, referrer, ModelKind::robot, place, options_));
    out.source = name;
    return out;
  } catch (const Error& error) {
    fail("{}: {}", place, error.what());
  }
}

fs::path Library::find_part(const std::string& name, const fs::path& robot,
                            const std::string& place) const {
  // in the folder iv/ beside the robot's file, or of the folder that the call names
  std::vector<fs::path> folders = {robot.parent_path() / "iv"};
  if (!options_.folder.empty()) folders.push_back(options_.folder / "iv");
  for (const auto& folder : folders) {
    try {
      return find_file(name, folder / "x", options_.beside_only());
    } catch (const Error&) {
      // the next one
    }
  }
  try {
    return find_file(name, robot, options_);
  } catch (const Error&) {
    return find_converted(name, folders.back() / "x", ModelKind::body, place,
                          options_.beside_only());
  }
}

BodySpec Library::part(const std::string& name, const fs::path& robot, const std::string& place) {
  try {
    const fs::path found = find_part(name, robot, place);
    BodySpec out = body(found);
    out.source = found.generic_string();
    return out;
  } catch (const Error& error) {
    fail("{}: {}", place, error.what());
  }
}

}  // namespace clench
