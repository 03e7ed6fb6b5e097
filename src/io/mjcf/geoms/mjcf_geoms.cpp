#include "clench/io/mjcf/geoms/mjcf_geoms.h"

#include <cmath>

#include "clench/base/suggest.h"
#include "clench/io/tree/tree_shapes.h"

namespace clench {

MjcfGeoms::MjcfGeoms(MjcfDocument& document, FileCache& cache, bool scene)
    : document_(document),
      cache_(cache),
      geometry_(cache.options(), BarePoints::hull),
      meshes_(document, cache, geometry_),
      scene_(scene),
      textures_(document, cache) {
  read_assets();
  for (const MjcfNode* node : document_.section("contact"))
    if (node->name() == "pair")
      for (const char* geom : {"geom1", "geom2"})
        paired_.insert(XmlValues(node->element).text(geom, ""));
}

// --- assets ---

static PieceColor color_of(const XmlValues& values, Repairs& repairs) {
  const auto rgba = values.color("rgba", 4, repairs);
  return {Eigen::Vector3d(rgba[0], rgba[1], rgba[2]).cast<float>(),
          static_cast<float>(1 - rgba[3])};
}

void MjcfGeoms::read_assets() {
  for (const MjcfNode* node : document_.section("asset")) {
    const XmlElement& element = node->element;
    if (node->name() == "mesh") {
      meshes_.add(element);
    } else if (node->name() == "material") {
      const XmlValues values = document_.values(element);
      if (values.has("rgba"))
        materials_[values.text("name")] = color_of(values, document_.repairs());
      texture_uses_[values.text("name", "")] = textures_.use_of(*node);
      document_.unused().attributes(
          element, {"name", "class", "rgba", "texture", "texrepeat", "texuniform"});
    } else if (node->name() == "texture") {
      textures_.add(element);
    } else if (node->name() != "model") {  // models are read when they are attached
      document_.unused().element(element);
    }
  }
}

// --- geoms ---

std::optional<PieceColor> MjcfGeoms::color(const XmlValues& geom,
                                           const std::string& fallback) const {
  if (geom.has("rgba")) return color_of(geom, document_.repairs());
  const auto found = materials_.find(geom.text("material", fallback));
  if (found == materials_.end()) return {};
  return found->second;
}

void MjcfGeoms::set_look(const XmlValues& values, const std::string& fallback_material,
                         MjcfGeom& geom) {
  geom.piece.color = color(values, fallback_material);
  const auto use = texture_uses_.find(values.text("material", fallback_material));
  if (use == texture_uses_.end() || use->second.texture.empty() || !geom.drawn) return;
  Eigen::Vector3d half = geom.piece.geometry->mesh.bounds().size() / 2;
  if (values.text("type", "sphere") == "plane") {
    const auto size = values.numbers("size", 0, 3);  // 0: infinite
    for (size_t i = 0; i < 2; ++i) half[static_cast<long>(i)] = i < size.size() ? size[i] : 0;
    half = half.unaryExpr([](double x) { return x > 0 ? x : 1; });
  }
  textures_.dress(use->second, half, values.text("type", "sphere") == "mesh", geom.piece);
}

/// Mass properties of the surface, by the sizes of TreeGeometry::primitive.
static MassProperties shell_of(const std::string& type, const std::vector<double>& size) {
  if (type == "box") return box_shell({size[0], size[1], size[2]});
  if (type == "ellipsoid") return ellipsoid_shell({size[0], size[1], size[2]});
  if (type == "cylinder") return cylinder_shell(size[0], size[1]);
  return capsule_shell(size[0], type == "sphere" ? 0 : size[1]);
}

/// size  half lengths and radii in the order of MJCF
void MjcfGeoms::set_solid(const std::string& type, std::vector<double> size,
                          const XmlValues& values, MjcfGeom& geom) {
  if (type == "capsule" || type == "cylinder") size[1] *= 2;
  if (type == "box")
    for (double& length : size) length *= 2;
  geom.piece = geometry_.primitive(type, size);
  geom.solid = values.boolean("shellinertia", false) ? shell_of(type, size) : solid_of(geom.piece);
  geom.solid.volume = std::abs(geom.solid.volume);
}

/// A sphere, capsule, cylinder, ellipsoid or box of half sizes; X is its frame.
void MjcfGeoms::set_primitive(const std::string& type, const XmlValues& values, MjcfGeom& geom,
                              Pose& X) {
  auto size = values.leading_numbers("size", 3);
  const bool round = type == "capsule" || type == "cylinder";
  const size_t expected = type == "sphere" ? 1 : round ? 2 : 3;
  if (values.has("fromto") && type != "sphere") {
    const auto v = values.numbers("fromto", 6, 6);
    const Eigen::Vector3d from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
    const double length = (to - from).stableNorm();
    if (!(length > 0)) values.fail("fromto", "expected two points, got the same twice");
    if (size.empty()) values.fail("size", "expected a radius, got none");
    X = {turn_z_to((from - to).stableNormalized()), 0.5 * (from + to)};
    size = round ? std::vector{size[0], length / 2} : std::vector{size[0], size[0], length / 2};
  }
  if (size.size() < expected)
    values.fail("size", "expected {} number{} for a {}, got {}", expected, expected > 1 ? "s" : "",
                type, size.size());
  for (double& length : size)
    length = document_.repairs().magnitude(length, values.subject("size"));
  for (size_t i = 0; i < expected; ++i)
    if (!(size[i] > 0)) values.fail("size", "expected lengths > 0, got {}", size[i]);
  size.resize(expected);
  set_solid(type, std::move(size), values, geom);
}

/// A primitive that replaces a mesh.
void MjcfGeoms::set_fitted(const std::string& type, const XmlValues& values, const MjcfMesh& mesh,
                           MjcfGeom& geom, Pose& X) {
  constexpr double no_length = 1e-12;  // [m]
  FittedPrimitive fitted = meshes_.fit(mesh, type, values);
  const bool capsule = type == "capsule";
  for (size_t i = 0; i < fitted.size.size(); ++i) {
    if (fitted.size[i] > no_length && std::isfinite(fitted.size[i])) continue;
    if (!capsule || i == 0)
      values.fail("mesh", "expected a mesh with a volume, to which a {} can be fitted", type);
    fitted.size[i] = 0;
  }
  X = X * fitted.X_MF;
  if (capsule && fitted.size[1] == 0)
    set_solid("sphere", {fitted.size[0]}, values, geom);
  else
    set_solid(type, fitted.size, values, geom);
  cache_.diagnostics().note(values.element().place().of("geom"), "a {} is fitted to mesh {}", type,
                            in_quotes(values.text("mesh")));
}

// size that replaces an infinite plane
static constexpr double plane_half_size = 5;    // [m]
static constexpr double plane_thickness = 0.1;  // [m]

/// A plate below z = 0, at least 10 m wide.
void MjcfGeoms::set_plane(const XmlValues& values, MjcfGeom& geom) {
  double x = plane_half_size, y = x;
  if (values.has("size")) {
    const auto size = values.numbers("size", 1, 3);
    x = std::max(x, std::abs(size[0]));
    y = std::max(y, size.size() > 1 ? std::abs(size[1]) : 0);
  }
  Mesh mesh = box_mesh({2 * x, 2 * y, plane_thickness});
  for (auto& p : mesh.vertices) p.z() -= plane_thickness / 2;
  geom.piece.geometry = geometry_.made(fmt::format("plane {} {}", x, y), std::move(mesh));
  cache_.diagnostics().note(values.element().place().of("geom"),
                            "a plane is infinite; a plate of {} x {} x {} m replaces it", 2 * x,
                            2 * y, plane_thickness);
}

void MjcfGeoms::read_friction(const XmlValues& values, MjcfGeom& geom) {
  OwnFriction& friction = geom.friction;
  if (values.has("friction"))
    friction.mu = document_.repairs().magnitude(values.leading_numbers("friction", 3)[0],
                                                values.subject("friction"));
  if (const auto wrong = fault(friction_rule, friction.mu); !wrong.empty())
    values.fail("friction", "{}", wrong);
  friction.priority = values.integer("priority", 0);
  friction.frictionless = values.integer("condim", 3) == 1;
  geom.friction_given = values.has("friction") || values.has("priority") || friction.frictionless;
}

void MjcfGeoms::read_mass(const XmlValues& values, MjcfGeom& geom) {
  geom.mass = values.has("mass")
                  ? values.not_negative("mass", 0, document_.repairs())
                  : values.not_negative("density", 1000, document_.repairs()) * geom.solid.volume;
  const int group = values.integer("group", 0);
  const auto& groups = document_.settings(values.element()).inertia_groups;
  geom.weighed = group >= groups[0] && group <= groups[1];
  if (!geom.weighed) geom.mass = 0;
}

std::optional<MjcfGeom> MjcfGeoms::read(const XmlElement& element, const std::string& child_class,
                                        const Pose& X_frame, bool of_world) {
  if (++count_ > max_pieces) element.fail("expected at most {} geoms", max_pieces);
  const XmlValues values = document_.values(element, child_class);
  values.tell_unused(
      document_.unused(),
      {"name",      "class",    "type",     "size",    "pos",         "quat",
       "axisangle", "euler",    "xyaxes",   "zaxis",   "fromto",      "mesh",
       "fitscale",  "material", "rgba",     "contype", "conaffinity", "group",
       "mass",      "density",  "friction", "condim",  "priority",    "shellinertia"});
  const std::string type = values.word(
      "type",
      {"plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"},
      "sphere");
  const auto skip = [&](const std::string& what) {
    unused_types_.insert(type);
    document_.losses().add("geom " + type, element.place().of("geom"), "{}; it is not used", what);
    return std::nullopt;
  };
  if ((type == "plane" && !of_world) || type == "hfield" || type == "sdf")
    return skip(of_world
                    ? fmt::format("no obstacle is made of a {} here", type)
                    : fmt::format("a {} is no part of a {} here", type, scene_ ? "body" : "robot"));
  MjcfGeom geom;
  read_friction(values, geom);
  geom.name = values.text("name", "");
  if (values.has("surfacevel"))
    cache_.diagnostics().warn(
        element.place().of("geom '{}'", excerpt(geom.name)),
        "surfacevel is not used; surface_velocity of its body makes a conveyor");
  geom.paired = !geom.name.empty() && paired_.contains(geom.name);
  geom.type = static_cast<unsigned>(values.integer("contype", 1));
  geom.affinity = static_cast<unsigned>(values.integer("conaffinity", 1));
  const int group = values.integer("group", 0);
  geom.drawn = group >= 0 && group <= 2;
  Pose X = document_.pose(values);
  std::string fallback_material;
  if (type == "mesh" || (values.has("mesh") && type != "plane")) {
    const MjcfMesh* mesh = meshes_.find(values, geom.collides());
    if (!mesh) return {};
    if (type == "mesh") {
      geom.piece.geometry = mesh->geometry;
      geom.solid = mesh->mass;
      fallback_material = mesh->material;
    } else {
      set_fitted(type, values, *mesh, geom, X);
    }
  } else if (type == "plane") {
    set_plane(values, geom);
  } else {
    set_primitive(type, values, geom, X);
  }
  geom.piece.X_LG = X_frame * X;
  set_look(values, fallback_material, geom);
  read_mass(values, geom);
  return geom;
}

}  // namespace clench
