#include "clench/io/write/write_body.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/base/watched.h"
#include "clench/io/graspit/world_parts.h"
#include "clench/io/mesh/mesh_files.h"
#include "clench/io/mesh/write_mesh.h"
#include "clench/io/write/saved_files.h"
#include "clench/spec/material_names.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

bool is_common(const std::string& material) {
  return std::ranges::count(material_names, material) > 0;
}

// properties of a body in addition to its surface
std::vector<std::string> matter_of(const BodySpec& body) {
  const BodySpec plain;
  std::vector<std::string> out;
  if (body.material != plain.material) out.push_back(fmt::format("material {}", body.material));
  if (body.mass != plain.mass) out.push_back(fmt::format("mass {} kg", body.mass));
  if (body.com) out.push_back("center of mass");
  if (body.inertia_per_mass) out.push_back("inertia");
  if (body.elastic_modulus)
    out.push_back(fmt::format("elastic modulus {} Pa", *body.elastic_modulus));
  if (body.tracker) out.push_back("tracker");
  return out;
}

// properties of an elastic body, which only worlds in Lua hold
void add_softness(const BodySpec& body, std::vector<std::string>& out) {
  const BodySpec plain;
  if (body.soft_layer != plain.soft_layer)
    out.push_back(fmt::format("soft layer {} m", body.soft_layer));
  if (body.poisson_ratio != plain.poisson_ratio)
    out.push_back(fmt::format("Poisson's ratio {}", body.poisson_ratio));
  if (body.restitution != plain.restitution)
    out.push_back(fmt::format("restitution {}", body.restitution));
  const auto add = [&](const char* name, double x) {
    if (x != 0) out.push_back(fmt::format("{} {}", name, x));
  };
  add("free damping", body.free_damping);
  add("free friction", body.free_friction);
  add("free armature", body.free_armature);
  add("gravity compensation", body.gravity_compensation);
}

// --- Inventor ---

std::string parameter_lines(const BodySpec& body) {
  std::string out;
  const auto to = std::back_inserter(out);
  if (is_common(body.material)) fmt::format_to(to, "#material {}\n", body.material);
  if (body.elastic_modulus) fmt::format_to(to, "#youngs {}\n", *body.elastic_modulus);
  if (body.tracker) fmt::format_to(to, "#useFlockOfBirds {}\n", *body.tracker);
  fmt::format_to(to, "#mass {}\n", number_in(body.mass, units::gram));
  if (body.com) fmt::format_to(to, "#cog {}\n", millimeters(*body.com));
  if (!body.inertia_per_mass) return out;
  out += "#inertia_matrix\n";
  for (int i = 0; i < 3; ++i) {
    std::vector<std::string> row;
    for (int j = 0; j < 3; ++j)
      row.push_back(number_in((*body.inertia_per_mass)(i, j), units::square_millimeter));
    fmt::format_to(to, "#{}\n", fmt::join(row, " "));
  }
  return out;
}

std::string inventor_text(const BodySpec& body) {
  std::string out = "#Inventor V2.0 ascii\n" + parameter_lines(body);
  const auto to = std::back_inserter(out);
  const Appearance& look = body.appearance;
  fmt::format_to(to,
                 "Separator {{\n  Material {{ diffuseColor {} {} {} transparency {} }}\n"
                 "  ShapeHints {{ vertexOrdering COUNTERCLOCKWISE shapeType {} }}\n",
                 look.color.x(), look.color.y(), look.color.z(), look.transparency,
                 body.shape && body.shape->closed() ? "SOLID" : "UNKNOWN_SHAPE_TYPE");
  if (body.shape) {
    const Mesh& mesh = body.shape->mesh();
    out += "  Coordinate3 { point [\n";
    StopCheck check(1 << 12);
    for (const auto& p : mesh.vertices) {
      check();
      fmt::format_to(to, "    {},\n", millimeters(p));
    }
    out += "  ] }\n  IndexedFaceSet { coordIndex [\n";
    for (const auto& t : mesh.triangles) {
      check();
      fmt::format_to(to, "    {}, {}, {}, -1,\n", t[0], t[1], t[2]);
    }
    out += "  ] }\n";
  }
  return out + "}\n";
}

// --- properties that a format cannot hold ---

std::vector<std::string> lost(const BodySpec& body, const std::string& ending) {
  std::vector<std::string> out;
  if (is_mesh_ending(ending))
    out = matter_of(body);
  else if (!is_common(body.material))
    out.push_back(fmt::format("material {}", body.material));
  add_softness(body, out);
  const Appearance& look = body.appearance;
  if (ending != ".iv" && look.given) out.push_back("color");
  if (ending == ".iv" && !look.triangle_colors.empty()) out.push_back("colors of triangles");
  if (look.skin) out.push_back("textures");
  if (look.visual) out.push_back("surface to be drawn");
  return out;
}

/// Number of triangles with two corners that are equal in 32 bits.
int too_small(const Mesh& mesh) {
  int count = 0;
  for (const Triangle& t : mesh.triangles) {
    Eigen::Vector3f p[3];
    for (int i = 0; i < 3; ++i) p[i] = (mesh.vertices[t[i]] / units::millimeter).cast<float>();
    count += p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
  }
  return count;
}

void tell(const BodySpec& body, const fs::path& path, const std::string& ending,
          const WriteOptions& options) {
  if (!options.diagnostics) return;
  const std::string file = path.filename().string();
  if (const auto list = lost(body, ending); !list.empty())
    options.diagnostics.lost(file, name_list(list));
  if (!body.shape) return;
  if (ending == ".iv" || ending == ".stl") {
    const int small = too_small(body.shape->mesh());
    options.diagnostics.warn(Place(file), "coordinates keep 32 bits, as {} holds them{}", ending,
                             small == 0   ? ""
                             : small == 1 ? "; a triangle is too small for them, and vanishes"
                                          : fmt::format("; {} triangles are too small for them, "
                                                        "and vanish",
                                                        small));
  }
  const double largest = body.shape->mesh().bounds().size().maxCoeff();
  if (is_mesh_ending(ending) && guess_mesh_unit(largest) != 1)
    options.diagnostics.warn(Place(file),
                             "it is {:.4g} m large, and {} names no unit: read it with the option "
                             "unit = \"m\", or it is taken for millimeters",
                             largest, ending);
}

}  // namespace

void write_body(const BodySpec& body, const fs::path& path, const WriteOptions& options) {
  const std::string ending = lower_case(path.extension().string()), file = path.filename().string();
  if (ending == ".xml") {
    check_folder_of(path);
    SavedFiles files(path, options);
    const std::string surface = files.write_surface(body).generic_string();
    write_file(path, body_xml_text(body, surface.empty() ? "" : files.name(surface)));
    files.keep();
  } else if (ending == ".iv") {
    write_file(path, inventor_text(body));
  } else if (is_mesh_ending(ending)) {
    if (!body.shape) fail("{}: '{}' has no surface to write", file, excerpt(body.name));
    write_mesh(body.shape->mesh(), path);
  } else {
    fail("{}: expected a body to .xml, .iv, .obj, .off, .ply or .stl, got {}", file,
         in_quotes(ending));
  }
  tell(body, path, ending, options);
}

}  // namespace clench
