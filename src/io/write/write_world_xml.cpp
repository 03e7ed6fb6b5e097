#include "clench/base/units.h"
#include "clench/io/graspit/world_parts.h"
#include "clench/io/text/xml.h"
#include "clench/io/write/write_text_worlds.h"

namespace clench {

static std::string element(const char* name, const std::string& text) {
  return fmt::format("    <{}>{}</{}>\n", name, xml_escaped(text), name);
}

static std::string body_element(const PlacedBody& placed, SavedFiles& files) {
  const char* name = placed.role == Role::obstacle ? "obstacle" : "graspableBody";
  std::string inside;
  if (files.again(placed.body)) {
    inside = element("filename", files.name(placed.body.file));
  } else {
    const std::string path = files.write_surface(placed.body).generic_string();
    const std::string surface = path.empty() ? "" : files.name(path);
    inside = "    <body>\n" + body_elements(placed.body, surface, "      ") + "    </body>\n";
  }
  return fmt::format("  <{}>\n{}{}  </{}>\n", name, inside, transform_element(placed.X_WB), name);
}

static std::string robot_element(const PlacedRobot& placed, SavedFiles& files) {
  files.again(placed.robot);
  files.warn_of_folders(placed.robot);
  return "  <robot>\n" + element("filename", files.name(placed.robot)) +
         element("dofValues", dof_values(placed)) + transform_element(placed.X_WB) + "  </robot>\n";
}

static std::string connection_element(const WorldSpec& world, const Connection& c,
                                      SavedFiles& files) {
  std::string out = "  <connection>\n" + element("parentRobot", fmt::format("{}", c.parent)) +
                    element("parentChain", fmt::format("{}", chain_of(world, c))) +
                    element("childRobot", fmt::format("{}", c.child));
  if (c.mount) {
    const std::string file =
        files.again(*c.mount) ? c.mount->file : files.write_body(*c.mount).generic_string();
    out += element("mountFilename", files.name(file));
  }
  return out + transform_element(c.X_LB) + "  </connection>\n";
}

static std::string camera_element(const Camera& camera) {
  return "  <camera>\n" + element("position", millimeters(camera.X_WC.position)) +
         element("orientation", orientation(camera.X_WC.rotation)) +
         element("focalDistance", number_in(camera.focal_distance, units::millimeter)) +
         "  </camera>\n";
}

std::string world_xml_text(const WorldSpec& world, SavedFiles& files) {
  std::string out = "<?xml version=\"1.0\" ?>\n<world>\n";
  for (const WorldEntry& entry : world.order) {
    if (entry.kind == WorldEntry::Kind::body)
      out += body_element(world.bodies[entry.index], files);
    else if (entry.kind == WorldEntry::Kind::robot)
      out += robot_element(world.robots[entry.index], files);
  }
  for (const Connection& c : world.connections) out += connection_element(world, c, files);
  if (world.camera) out += camera_element(*world.camera);
  return out + "</world>\n";
}

}  // namespace clench
