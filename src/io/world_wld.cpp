#include "io/world_wld.h"

#include <algorithm>
#include <iterator>

#include "base/suggest.h"
#include "base/text.h"
#include "base/units.h"
#include "io/transform_list.h"
#include "io/transform_tags.h"
#include "spec/material_names.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

class WldReader {
 public:
  WldReader(const fs::path& path, Library& library)
      : path_(path), library_(library), lines_(path.filename().string(), read_text(path)) {}
  WorldSpec read();

 private:
  void read_header();
  void read_body(Role role);
  void read_robot();
  void read_dofs(const Line& line, PlacedRobot& placed);
  void read_connection();
  void read_camera(bool focal_distance);
  void check_connections();
  /// warns of words behind the first `used`
  void used_up(const Line& line, int used) const {
    if (const std::string sentence = line.surplus(used); !sentence.empty()) library_.warn(sentence);
  }
  Pose pose();
  bool begins_pose(const Line& line) const;
  fs::path file(const Line& line) const;
  /// runs a reader of another file; what it throws gets this line's place
  template <class Read>
  auto at(const Line& line, Read read) const;

  const fs::path& path_;
  Library& library_;
  LineReader lines_;
  std::vector<Line> connection_lines_;
  WorldSpec world_;
};

template <class Read>
auto WldReader::at(const Line& line, Read read) const {
  try {
    return read();
  } catch (const Error& error) {
    line.fail("{}", error.what());
  }
}

bool WldReader::begins_pose(const Line& line) const {
  const std::string_view text = line.text();
  return text.starts_with("T ") || text.starts_with("T\t") || text.starts_with("T(") ||
         text.starts_with('(') || text.starts_with('<');
}

Pose WldReader::pose() {
  const Line line = lines_.next_full("a transform 'T (w x y z)[x y z]'");
  if (line.text().starts_with('<'))
    return read_tagged_transform(line, lines_, library_.options().warn);
  if (!begins_pose(line))
    line.fail("wanted a transform 'T (w x y z)[x y z]', got {}", in_quotes(line.text()));
  const std::string_view text = line.text();
  return read_full_transform(line, trim(text.substr(text.front() == 'T' ? 1 : 0)));
}

fs::path WldReader::file(const Line& line) const {
  const std::string name(line.text());
  return at(line, [&] {
    try {
      return find_file(name, path_, library_.options());
    } catch (const Error& missing) {
      // files that were converted to XML since
      fs::path sibling;
      try {
        sibling =
            find_file(fs::path(name).replace_extension(".xml").string(), path_, library_.options());
      } catch (const Error&) {
        throw missing;
      }
      fail("no such file: {}; there is {}, which is not read", name, sibling.filename().string());
    }
  });
}

void WldReader::read_header() {
  // comments, then a block; the first comment should name the program
  const Line first = lines_.peek();
  const bool named = lower_case(first.text()).starts_with("#graspit!");
  if (!named && !lines_.skip_to_full())
    first.fail("wanted '#GraspIt! version ...', got {}", in_quotes(first.text()));
  if (!named) library_.warn(first.place() + ": the first line '#GraspIt! version ...' is missing");
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
      line.fail("wanted {} alone on its line, got {}", key, in_quotes(line.text()));
    if (key == "Obstacle")
      read_body(Role::obstacle);
    else if (key == "GraspableBody")
      read_body(Role::object);
    else if (key == "Robot")
      read_robot();
    else if (key == "Connection")
      connection_lines_.push_back(line), read_connection();
    else if (key == "Camera")
      read_camera(false);
    else if (key == "CameraFull")
      read_camera(true);
    else
      line.fail("wanted Obstacle, GraspableBody, Robot, Connection, Camera or CameraFull, got {}{}",
                in_quotes(line.text()),
                did_you_mean(key, {std::begin(block_names), std::end(block_names)}));
  }
  check_connections();
  return std::move(world_);
}

void WldReader::read_body(Role role) {
  const Line line = lines_.next_full("the file of a body");
  PlacedBody placed;
  placed.role = role;
  placed.body = at(line, [&, found = file(line)] { return library_.body(found); });
  placed.body.source = line.text();
  // an obstacle names its material, in most files
  if (lines_.skip_to_full() && !begins_pose(lines_.peek())) {
    const Line material = lines_.peek();
    if (role == Role::obstacle) {
      lines_.next();
      at(material, [&] { check_material(material.text()); });
      placed.body.material = material.text();
    }
  }
  placed.X_WB = pose();
  world_.order.push_back({WorldEntry::Kind::body, static_cast<int>(world_.bodies.size())});
  world_.bodies.push_back(std::move(placed));
}

void WldReader::read_robot() {
  const Line line = lines_.next_full("the file of a robot");
  PlacedRobot placed;
  placed.robot = at(line, [&, found = file(line)] { return library_.robot(found); });
  placed.robot.source = line.text();
  if (placed.robot.dofs.empty()) {
    if (lines_.peek().blank()) lines_.next();
  } else {
    read_dofs(lines_.next_full("the values of the DOFs").before('#'), placed);
  }
  placed.X_WB = pose();
  world_.order.push_back({WorldEntry::Kind::robot, static_cast<int>(world_.robots.size())});
  world_.robots.push_back(std::move(placed));
}

void WldReader::read_dofs(const Line& line, PlacedRobot& placed) {
  const RobotSpec& robot = placed.robot;
  const int dofs = static_cast<int>(robot.dofs.size());
  int next = 0;
  // one value a DOF and nothing else is understood too
  const bool plain = line.size() == dofs;
  for (const auto& chain : robot.chains) placed.breakaway.emplace_back(chain.joints.size());
  for (int d = 0; d < dofs; ++d) {
    bool slides = false;
    std::vector<std::pair<size_t, size_t>> joints;
    for (size_t c = 0; c < robot.chains.size(); ++c)
      for (size_t j = 0; j < robot.chains[c].joints.size(); ++j)
        if (robot.chains[c].joints[j].dof == d) {
          if (joints.empty()) slides = robot.chains[c].joints[j].kind == JointKind::prismatic;
          joints.push_back({c, j});
        }
    const double unit = slides ? units::millimetre : 1.0;
    placed.dofs.push_back(line.number(next++, fmt::format("DOF {} of {}", d, dofs)) * unit);
    if (robot.dofs[d].kind != DofKind::breakaway || plain) continue;
    for (const auto& [c, j] : joints) {
      const std::string what = fmt::format("DOF {}: joint {} of chain {}", d, j, c);
      if (line.integer(next++, what + ": broken away (0 or 1)", 0, 1) == 0) continue;
      // written as the value of the DOF at which the joint stopped
      placed.breakaway[c][j] = line.number(next++, what) * unit * robot.chains[c].joints[j].ratio;
    }
  }
  if (next < line.size())
    line.fail("wanted {} numbers for the {} DOFs of {}, got {}", next, dofs, robot.name,
              line.size());
}

void WldReader::read_connection() {
  const Line line = lines_.next_full("'parent chain child' of a connection");
  Connection c;
  c.parent = line.integer(0, "parent robot", 0);
  c.chain = line.integer(1, "parent chain", 0);
  c.child = line.integer(2, "child robot", 0);
  used_up(line, 3);
  // the line of the mount may be empty
  const Line mount = lines_.peek();
  if (!begins_pose(mount)) lines_.next();
  if (!mount.blank() && !begins_pose(mount) && !mount.text().starts_with('#')) {
    c.mount = at(mount, [&, found = file(mount)] { return library_.body(found); });
    c.mount->source = mount.text();
  }
  c.X_LB = pose();
  connection_lines_.back() = line;
  world_.connections.push_back(std::move(c));
}

void WldReader::check_connections() {
  const int robots = static_cast<int>(world_.robots.size());
  std::vector<bool> carried(robots);
  for (size_t i = 0; i < world_.connections.size(); ++i) {
    const Connection& c = world_.connections[i];
    const Line& line = connection_lines_[i];
    if (c.parent >= robots)
      line.fail("parent robot: wanted one of {} robots, got {}", robots, c.parent);
    if (c.child >= robots)
      line.fail("child robot: wanted one of {} robots, got {}", robots, c.child);
    if (c.parent == c.child)
      line.fail("child robot: wanted another robot than the parent, got {}", c.child);
    const auto& chains = world_.robots[c.parent].robot.chains;
    if (c.chain >= static_cast<int>(chains.size()))
      line.fail("parent chain: wanted one of {} chains of {}, got {}", chains.size(),
                world_.robots[c.parent].robot.name, c.chain);
    if (chains[c.chain].links.empty())
      line.fail("parent chain: chain {} has no link to carry a robot", c.chain);
    if (carried[c.child]) line.fail("child robot: robot {} is carried already", c.child);
    carried[c.child] = true;
  }
}

void WldReader::read_camera(bool focal_distance) {
  const Line line = lines_.next_full("7 numbers of a camera");
  double x[8];
  for (int i = 0; i < 7; ++i)
    x[i] = line.number(i, i < 3 ? "camera position" : "camera orientation (x y z w)");
  const Eigen::Quaterniond q(x[6], x[3], x[4], x[5]);  // Inventor's order is x y z w
  const double norm = q.coeffs().stableNorm();
  if (!(norm > 1e-6) || !std::isfinite(norm))
    line.fail("camera orientation: wanted a quaternion of length 1, got {} {} {} {}", x[3], x[4],
              x[5], x[6]);
  used_up(line, focal_distance ? 8 : 7);
  Camera camera;
  camera.X_WC = {Eigen::Quaterniond(q.coeffs() / norm),
                 Eigen::Vector3d(x[0], x[1], x[2]) * units::millimetre};
  if (focal_distance) camera.focal_distance = line.number(7, "focal distance") * units::millimetre;
  world_.camera = camera;
}

}  // namespace

WorldSpec read_world_wld(const fs::path& path, Library& library) {
  return WldReader(path, library).read();
}

}  // namespace clench
