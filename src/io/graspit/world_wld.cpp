#include "clench/io/graspit/graspit_readers.h"

#include <algorithm>
#include <iterator>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/io/graspit/transform_list.h"
#include "clench/io/graspit/transform_tags.h"
#include "clench/io/graspit/world_parts.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/number_reader.h"
#include "clench/spec/material_names.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

class WldReader {
 public:
  WldReader(const fs::path& path, FileCache& cache)
      : path_(path), cache_(cache), lines_(path.filename().string(), read_text(path)) {}
  WorldSpec read();

 private:
  void read_header();
  void read_body(Role role);
  void read_robot();
  void read_connection();
  void read_camera(bool focal_distance);
  Pose pose();
  Pose any_pose();
  bool begins_pose(const Line& line) const;

  const fs::path& path_;
  FileCache& cache_;
  LineReader lines_;
  std::vector<ConnectionPlace> connection_places_;
  WorldSpec world_;
};

bool WldReader::begins_pose(const Line& line) const {
  const std::string_view text = line.text();
  return text.starts_with("T ") || text.starts_with("T\t") || text.starts_with("T(") ||
         text.starts_with('(') || text.starts_with('<');
}

Pose WldReader::pose() {
  lines_.skip_to_full();
  const std::string place = lines_.peek().place().text();
  const Pose X = any_pose();
  check_place(X, place);
  return X;
}

Pose WldReader::any_pose() {
  const Line line = lines_.next_full("a transform 'T (w x y z)[x y z]'");
  if (line.text().starts_with('<'))
    return read_tagged_transform(line, lines_, cache_.diagnostics());
  if (!begins_pose(line))
    line.fail("expected a transform 'T (w x y z)[x y z]', got {}", in_quotes(line.text()));
  const std::string_view text = line.text();
  return read_full_transform(line, trim(text.substr(text.front() == 'T' ? 1 : 0)),
                             cache_.diagnostics());
}

void WldReader::read_header() {
  // comments before the first block; the first comment should name the program
  const Line first = lines_.peek();
  const bool named = lower_case(first.text()).starts_with("#graspit!");
  if (!named && !lines_.skip_to_full())
    first.fail("expected '#GraspIt! version ...', got {}", in_quotes(first.text()));
  if (!named)
    cache_.diagnostics().suspected(first.place(),
                                   "the first line '#GraspIt! version ...' is missing");
}

static constexpr const char* block_names[] = {"Obstacle",   "GraspableBody", "Robot",
                                              "Connection", "Camera",        "CameraFull"};

WorldSpec WldReader::read() {
  world_.source = path_.generic_string();
  read_header();
  while (lines_.skip_to_full()) {
    const Line line = lines_.next();
    const std::string_view key = line.word(0);
    const bool known = std::ranges::find(block_names, key) != std::end(block_names);
    if (known && line.before('#').size() > 1)
      line.fail("expected {} alone on its line, got {}", key, in_quotes(line.text()));
    if (key == "Obstacle")
      read_body(Role::obstacle);
    else if (key == "GraspableBody")
      read_body(Role::object);
    else if (key == "Robot")
      read_robot();
    else if (key == "Connection")
      read_connection();
    else if (key == "Camera")
      read_camera(false);
    else if (key == "CameraFull")
      read_camera(true);
    else
      line.fail(
          "expected Obstacle, GraspableBody, Robot, Connection, Camera or CameraFull, got {}{}",
          in_quotes(line.text()),
          did_you_mean(key, {std::begin(block_names), std::end(block_names)}));
  }
  find_connections(world_, connection_places_);
  return std::move(world_);
}

void WldReader::read_body(Role role) {
  const Line line = lines_.next_full("the file of a body");
  PlacedBody placed;
  placed.role = role;
  placed.body = cache_.named_body(std::string(line.text()), path_, line.place());
  // in most files the material follows the file of an obstacle
  if (lines_.skip_to_full() && !begins_pose(lines_.peek())) {
    const Line material = lines_.peek();
    if (role == Role::obstacle) {
      lines_.next();
      errors_at(material, [&] { check_material(material.text()); });
      placed.body.material = material.text();
      placed.body.material_from = Origin::file;
    }
  }
  placed.X_WB = pose();
  world_.order.push_back({WorldEntry::Kind::body, static_cast<int>(world_.bodies.size())});
  world_.bodies.push_back(std::move(placed));
}

void WldReader::read_robot() {
  const Line line = lines_.next_full("the file of a robot");
  PlacedRobot placed;
  placed.robot = cache_.named_robot(std::string(line.text()), path_, line.place());
  if (placed.robot.dofs.empty()) {
    if (lines_.peek().blank()) lines_.next();
  } else {
    read_dof_values(lines_.next_full("the values of the DOFs").before('#'), placed,
                    cache_.diagnostics());
  }
  placed.X_WB = pose();
  world_.order.push_back({WorldEntry::Kind::robot, static_cast<int>(world_.robots.size())});
  world_.robots.push_back(std::move(placed));
}

void WldReader::read_connection() {
  const Line line = lines_.next_full("'parent chain child' of a connection");
  Connection c;
  c.parent = line.integer(0, "parent robot", 0);
  const int chain = line.integer(1, "parent chain", 0);
  c.child = line.integer(2, "child robot", 0);
  warn_of_surplus(line, 3, cache_.diagnostics());
  // the line of the mount may be empty
  const Line mount = lines_.peek();
  if (!begins_pose(mount)) lines_.next();
  if (!mount.blank() && !begins_pose(mount) && !mount.text().starts_with('#')) {
    c.mount = cache_.named_body(std::string(mount.text()), path_, mount.place());
  }
  c.X_LB = pose();
  connection_places_.push_back({line.place(), chain});
  world_.connections.push_back(std::move(c));
}

void WldReader::read_camera(bool focal_distance) {
  const Line line = lines_.next_full("7 numbers of a camera");
  double x[8];
  for (int i = 0; i < 7; ++i)
    x[i] = line.number(i, i < 3 ? "camera position" : "camera orientation (x y z w)");
  const auto q = camera_orientation({x[3], x[4], x[5], x[6]}, line.place().of("camera orientation"),
                                    cache_.options());
  if (!q) return;
  warn_of_surplus(line, focal_distance ? 8 : 7, cache_.diagnostics());
  Camera camera;
  camera.X_WC = {*q, Eigen::Vector3d(x[0], x[1], x[2]) * units::millimeter};
  if (focal_distance) camera.focal_distance = line.number(7, "focal distance") * units::millimeter;
  world_.camera = checked_camera(camera, line.place(), cache_.options());
}

}  // namespace

WorldSpec read_world_wld(const fs::path& path, FileCache& cache) {
  return WldReader(path, cache).read();
}

}  // namespace clench
