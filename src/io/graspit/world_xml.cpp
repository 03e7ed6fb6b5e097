#include "clench/io/graspit/graspit_readers.h"

#include "clench/base/units.h"
#include "clench/io/graspit/body_xml.h"
#include "clench/io/graspit/transform_tags.h"
#include "clench/io/graspit/world_parts.h"
#include "clench/io/text/repair_names.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

class XmlWorldReader {
 public:
  XmlWorldReader(const XmlElement& root, const fs::path& path, FileCache& cache)
      : root_(root), path_(path), cache_(cache) {}
  WorldSpec read();

 private:
  const Diagnostics& diagnostics() const { return cache_.diagnostics(); }
  void read_body(const XmlElement& element, Role role);
  BodySpec inline_body(const XmlElement& element);
  void read_robot(const XmlElement& element);
  void read_connection(const XmlElement& element);
  void read_camera(const XmlElement& element);
  Pose pose(const XmlElement& element) const;

  const XmlElement root_;
  const fs::path& path_;
  FileCache& cache_;
  std::vector<ConnectionPlace> connection_places_;
  WorldSpec world_;
};

WorldSpec XmlWorldReader::read() {
  root_.check({.once = {"camera"}, .many = {"obstacle", "graspableBody", "robot", "connection"}},
              diagnostics());
  world_.source = path_.generic_string();
  // unknown elements are already reported
  for (const XmlElement& e : root_.children()) {
    if (e.name() == "obstacle")
      read_body(e, Role::obstacle);
    else if (e.name() == "graspableBody")
      read_body(e, Role::object);
    else if (e.name() == "robot")
      read_robot(e);
    else if (e.name() == "connection")
      read_connection(e);
    else if (e.name() == "camera" && !world_.camera)
      read_camera(e);
  }
  find_connections(world_, connection_places_);
  return std::move(world_);
}

Pose XmlWorldReader::pose(const XmlElement& element) const {
  if (!element.child("transform"))
    diagnostics().note(element.place().of(element.name()),
                       "no <transform>; it is placed at the origin");
  const Pose X = read_transform_of(element, cache_.diagnostics());
  check_place(X, fmt::format("{}: {}", element.place(), element.name()));
  return X;
}

BodySpec XmlWorldReader::inline_body(const XmlElement& element) {
  BodySpec body = read_body_element(element, path_, cache_);
  const XmlElement geometry = element.child("geometryFile");
  body.name = geometry ? fs::path(geometry.text()).stem().string() : "body";
  repair_names(body, element.place(), cache_.options());
  return body;
}

void XmlWorldReader::read_body(const XmlElement& element, Role role) {
  element.check({.once = {"filename", "body", "transform"}}, diagnostics());
  PlacedBody placed;
  placed.role = role;
  const XmlElement own = element.child("body"), name = element.child("filename");
  if (own) {
    if (name && lower_case(name.text()) != "unspecified")
      diagnostics().repaired(name.place().of(element.name()),
                             "expected <filename> or <body>, got both; <body> is used");
    placed.body = inline_body(own);
  } else {
    const XmlElement file = element.expected("filename");
    file.check({}, diagnostics());
    placed.body = cache_.named_body(file.text(), path_, file.place());
  }
  placed.X_WB = pose(element);
  world_.order.push_back({WorldEntry::Kind::body, static_cast<int>(world_.bodies.size())});
  world_.bodies.push_back(std::move(placed));
}

void XmlWorldReader::read_robot(const XmlElement& element) {
  element.check({.once = {"filename", "dofValues", "transform"}}, diagnostics());
  PlacedRobot placed;
  const XmlElement file = element.expected("filename");
  file.check({}, diagnostics());
  placed.robot = cache_.named_robot(file.text(), path_, file.place());
  const XmlElement values = element.child("dofValues");
  if (values) {
    const std::string text = values.text();
    read_dof_values(values.as_line(text), placed, cache_.diagnostics());
  } else if (!placed.robot.dofs.empty()) {
    diagnostics().note(element.place().of("robot"),
                       "no <dofValues>; its DOFs start at their defaults");
  }
  placed.X_WB = pose(element);
  world_.order.push_back({WorldEntry::Kind::robot, static_cast<int>(world_.robots.size())});
  world_.robots.push_back(std::move(placed));
}

void XmlWorldReader::read_connection(const XmlElement& element) {
  element.check(
      {.once = {"parentRobot", "parentChain", "childRobot", "mountFilename", "transform"}},
      diagnostics());
  Connection c;
  c.parent = element.expected("parentRobot").integer(0);
  const int chain = element.expected("parentChain").integer(0);
  c.child = element.expected("childRobot").integer(0);
  if (const XmlElement mount = element.child("mountFilename"); mount && !mount.text().empty())
    c.mount = cache_.named_body(mount.text(), path_, mount.place());
  c.X_LB = pose(element);
  connection_places_.push_back({element.place(), chain});
  world_.connections.push_back(std::move(c));
}

void XmlWorldReader::read_camera(const XmlElement& element) {
  element.check({.once = {"position", "orientation", "focalDistance"}}, diagnostics());
  const XmlElement turn = element.expected("orientation");
  const auto q = camera_orientation(Eigen::Vector4d(turn.numbers(4).data()),
                                    turn.place().of("orientation"), cache_.options());
  if (!q) return;
  Camera camera;
  camera.X_WC = {*q, element.expected("position").vector() * units::millimeter};
  if (const XmlElement focus = element.child("focalDistance"))
    camera.focal_distance = focus.number() * units::millimeter;
  world_.camera = checked_camera(camera, element.place(), cache_.options());
}

}  // namespace

WorldSpec read_world_xml(const fs::path& path, FileCache& cache) {
  const XmlFile file(path);
  return XmlWorldReader(file.root(), path, cache).read();
}

}  // namespace clench
