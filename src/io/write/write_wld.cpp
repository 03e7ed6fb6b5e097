#include <algorithm>

#include "clench/base/units.h"
#include "clench/io/graspit/world_parts.h"
#include "clench/io/write/write_text_worlds.h"
#include "clench/spec/material_names.h"

namespace clench {

/// A name as a separate line that is not parsed as a comment.
static std::string in_a_line(const std::string& name) {
  if (name.find_first_of("\r\n") != std::string::npos || name != trim(name) ||
      name.starts_with('#'))
    fail("the name of a file cannot be written in a line of a .wld: {}", in_quotes(name));
  return name + "\n";
}

static std::string body_file(const BodySpec& body, SavedFiles& files) {
  const std::string file = files.again(body) ? body.file : files.write_body(body).generic_string();
  return in_a_line(files.name(file));
}

static std::string body_block(const PlacedBody& placed, SavedFiles& files) {
  const bool obstacle = placed.role == Role::obstacle;
  std::string out = obstacle ? "Obstacle\n" : "GraspableBody\n";
  out += body_file(placed.body, files);
  if (obstacle && std::ranges::count(material_names, placed.body.material))
    out += placed.body.material + "\n";
  return out + "T " + full_transform(placed.X_WB) + "\n\n";
}

static std::string robot_block(const PlacedRobot& placed, SavedFiles& files) {
  files.again(placed.robot);
  files.warn_of_folders(placed.robot);
  return "Robot\n" + in_a_line(files.name(placed.robot)) + dof_values(placed) + "\nT " +
         full_transform(placed.X_WB) + "\n\n";
}

std::string wld_text(const WorldSpec& world, SavedFiles& files) {
  std::string out = "#GraspIt! version 2.0\n";
  for (const WorldEntry& entry : world.order) {
    if (entry.kind == WorldEntry::Kind::body)
      out += body_block(world.bodies[entry.index], files);
    else if (entry.kind == WorldEntry::Kind::robot)
      out += robot_block(world.robots[entry.index], files);
  }
  // robots are counted in the order of their blocks
  for (const Connection& c : world.connections)
    out += fmt::format("Connection\n{} {} {}\n{}T {}\n\n", c.parent, chain_of(world, c), c.child,
                       c.mount ? body_file(*c.mount, files) : "\n", full_transform(c.X_LB));
  if (world.camera)
    out += fmt::format("CameraFull\n{} {} {}\n", millimeters(world.camera->X_WC.position),
                       orientation(world.camera->X_WC.rotation),
                       number_in(world.camera->focal_distance, units::millimeter));
  return out;
}

}  // namespace clench
