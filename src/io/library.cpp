#include "io/library.h"

#include "base/text.h"
#include "io/inventor.h"
#include "io/inventor_params.h"
#include "io/mesh_files.h"
#include "io/robot_cfg.h"

namespace clench {

namespace fs = std::filesystem;

static BodySpec load_body(const fs::path& path, const ReadOptions& options) {
  const std::string extension = lower_case(path.extension().string()),
                    file = path.filename().string();
  BodySpec body;
  body.name = path.stem().string();
  body.source = path.generic_string();
  Geometry geometry;
  if (extension == ".iv" || extension == ".wrl" || extension == ".vrml") {
    const std::string text = read_text(path);
    read_inventor_params(text, file, options, body);
    geometry = read_inventor(path, text, options);
  } else if (extension == ".obj" || extension == ".stl") {
    geometry = read_mesh_file(path, options);
  } else {
    fail("{}: wanted a body from .iv, .wrl, .obj or .stl, got {}", file, in_quotes(extension));
  }
  body.appearance = std::move(geometry.appearance);
  if (!geometry.mesh.triangles.empty()) body.shape = Shape::make(std::move(geometry.mesh), file);
  return body;
}

const BodySpec& Library::body(const fs::path& path) {
  auto found = bodies_.find(path);
  if (found == bodies_.end()) found = bodies_.emplace(path, load_body(path, options_)).first;
  return found->second;
}

const RobotSpec& Library::robot(const fs::path& path) {
  auto found = robots_.find(path);
  const std::string extension = lower_case(path.extension().string());
  if (extension != ".cfg")
    fail("{}: wanted a robot from .cfg, got {}", path.filename().string(), in_quotes(extension));
  if (found == robots_.end()) found = robots_.emplace(path, read_robot_cfg(path, *this)).first;
  return found->second;
}

}  // namespace clench
