#include "clench/io/mjcf/mjcf_geoms.h"

#include <cmath>

#include "clench/base/convert.h"
#include "clench/base/suggest.h"
#include "clench/geometry/mesh/hull.h"
#include "clench/io/tree/tree_shapes.h"
#include "clench/math/decompositions.h"

namespace clench {

MjcfGeoms::MjcfGeoms(MjcfDocument& document, FileCache& cache, bool scene)
    : document_(document), cache_(cache), geometry_(cache.options()), scene_(scene) {
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
    const XmlValues values = document_.values(element);
    if (node->name() == "mesh") {
      std::string name = values.text("name", "");
      if (name.empty()) name = std::filesystem::path(values.text("file")).stem().string();
      if (!meshes_.emplace(name, Asset{element, values, nullptr}).second)
        document_.repairs().add("mesh",
                                fmt::format("{}: mesh: there is another one of the name '{}'; "
                                            "the first one counts",
                                            element.place(), excerpt(name)));
      document_.unused().attributes(element, {"name", "class", "file", "scale", "refpos", "refquat",
                                              "vertex", "face", "content_type"});
    } else if (node->name() == "material") {
      if (values.has("rgba"))
        materials_[values.text("name")] = color_of(values, document_.repairs());
      document_.unused().attributes(element, {"name", "class", "rgba"});
    } else {
      document_.unused().element(element);
    }
  }
}

/// Points and faces that stand in the model itself; points alone mean their convex hull.
std::shared_ptr<const Geometry> MjcfGeoms::inline_mesh(const Asset& asset) {
  constexpr int most = 3'000'000;
  const auto numbers = asset.values.numbers("vertex", 12, most);
  Mesh mesh;
  for (size_t i = 0; i + 2 < numbers.size(); i += 3)
    mesh.vertices.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  const int count = static_cast<int>(mesh.vertices.size());
  if (asset.values.has("face")) {
    const auto faces = asset.values.numbers("face", 3, most);
    for (size_t i = 0; i + 2 < faces.size(); i += 3) {
      for (int k = 0; k < 3; ++k)
        if (!(faces[i + k] >= 0 && faces[i + k] < count) ||
            faces[i + k] != std::floor(faces[i + k]))
          asset.values.fail("face", "expected vertices from 0 to {}, got {}", count - 1,
                            faces[i + k]);
      mesh.triangles.push_back(
          {floor_int(faces[i]), floor_int(faces[i + 1]), floor_int(faces[i + 2])});
    }
  } else {
    const Eigen::Map<const Eigen::MatrixXd> points(numbers.data(), 3, count);
    const Hull hull = convex_hull(points);
    if (!hull.full()) asset.values.fail("vertex", "expected points that span a solid");
    mesh.triangles = hull_triangles(hull, points);
  }
  Geometry geometry;
  geometry.mesh = std::move(mesh);
  return std::make_shared<const Geometry>(std::move(geometry));
}

std::shared_ptr<const Geometry> MjcfGeoms::read_mesh(Asset& asset) {
  if (asset.geometry) return asset.geometry;
  const XmlValues& values = asset.values;
  auto geometry = values.has("vertex")
                      ? inline_mesh(asset)
                      : geometry_.file(document_.mesh_file(values.text("file"), cache_.options()));
  const Eigen::Vector3d scale = values.vec3("scale", {1, 1, 1}),
                        origin = values.vec3("refpos", {0, 0, 0});
  if (scale.cwiseAbs().minCoeff() == 0) values.fail("scale", "expected factors other than 0");
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  if (values.has("refquat")) {
    const auto q = values.numbers("refquat", 4, 4);
    turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    if (!(turn.norm() > 1e-9)) values.fail("refquat", "expected a quaternion, got zeros");
    turn.normalize();
  }
  if (!values.has("scale") && !values.has("refpos") && !values.has("refquat"))
    return asset.geometry = geometry;
  Geometry moved = *geometry;
  for (auto& p : moved.mesh.vertices) p = turn.conjugate() * (p.cwiseProduct(scale) - origin);
  if (scale.prod() < 0)
    for (auto& t : moved.mesh.triangles) std::swap(t[1], t[2]);
  return asset.geometry = std::make_shared<const Geometry>(std::move(moved));
}

/// null: it is not there, and nobody needs it but pictures
std::shared_ptr<const Geometry> MjcfGeoms::mesh(const XmlValues& geom, bool collides) {
  const std::string name = geom.text("mesh");
  const auto found = meshes_.find(name);
  if (found == meshes_.end())
    geom.fail("mesh", "no mesh {}{}", in_quotes(name), did_you_mean(name, names_in(meshes_)));
  Asset& asset = found->second;
  try {
    return read_mesh(asset);
  } catch (const Error& error) {
    const std::string what = error.what(), place = asset.element.place();
    const std::string sentence = what.starts_with(place) ? what : place + ": mesh: " + what;
    if (collides) throw Error(sentence);
    cache_.warn(sentence + "; it is not drawn");
    return nullptr;
  }
}

// --- geoms ---

std::optional<PieceColor> MjcfGeoms::color(const XmlValues& geom) const {
  if (geom.has("rgba")) return color_of(geom, document_.repairs());
  const auto found = materials_.find(geom.text("material", ""));
  if (found == materials_.end()) return {};
  return found->second;
}

/// A sphere, capsule, cylinder, ellipsoid or box of half sizes; X is its frame.
void MjcfGeoms::set_primitive(const std::string& type, const XmlValues& values, MjcfGeom& geom,
                              Pose& X) {
  auto size = values.has("size") ? values.numbers("size", 1, 3) : std::vector<double>();
  const bool round = type == "capsule" || type == "cylinder";
  size_t expected = type == "sphere" ? 1 : round ? 2 : 3;
  if (values.has("fromto") && type != "sphere") {
    const auto v = values.numbers("fromto", 6, 6);
    const Eigen::Vector3d from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
    const double length = (to - from).stableNorm();
    if (!(length > 0)) values.fail("fromto", "expected two points, got the same twice");
    if (size.empty()) values.fail("size", "expected a radius, got none");
    X = {shortest_rotation(Eigen::Vector3d::UnitZ(), (from - to).stableNormalized()).normalized(),
         0.5 * (from + to)};
    size = round ? std::vector{size[0], length / 2} : std::vector{size[0], size[0], length / 2};
  }
  if (size.size() < expected)
    values.fail("size", "expected {} number{} for a {}, got {}", expected, expected > 1 ? "s" : "",
                type, size.size());
  for (double& length : size)
    length = document_.repairs().magnitude(length, values.subject("size"));
  for (size_t i = 0; i < expected; ++i)
    if (!(size[i] > 0)) values.fail("size", "expected lengths > 0, got {}", size[i]);
  // half sizes, but for radii
  size.resize(expected);
  if (round) size[1] *= 2;
  if (type == "box")
    for (double& length : size) length *= 2;
  geom.piece = geometry_.primitive(type, size);
}

// a plane has no end and no thickness
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
  cache_.note(fmt::format("{}: geom: a plane has no end; a plate of {} x {} x {} m stands for it",
                          values.element().place(), 2 * x, 2 * y, plane_thickness));
}

std::optional<MjcfGeom> MjcfGeoms::read(const XmlElement& element, const std::string& child_class,
                                        const Pose& X_frame, bool of_world) {
  if (++count_ > max_pieces) element.fail("expected at most {} geoms", max_pieces);
  const XmlValues values = document_.values(element, child_class);
  if (scene_)
    values.tell_unused(document_.unused(),
                       {"name",      "class",    "type",    "size",        "pos",    "quat",
                        "axisangle", "euler",    "xyaxes",  "zaxis",       "fromto", "mesh",
                        "material",  "rgba",     "contype", "conaffinity", "group",  "mass",
                        "density",   "friction", "condim",  "priority"});
  else
    values.tell_unused(document_.unused(),
                       {"name", "class", "type", "size", "pos", "quat", "axisangle", "euler",
                        "xyaxes", "zaxis", "fromto", "mesh", "material", "rgba", "contype",
                        "conaffinity", "group", "mass", "density"});
  const std::string type = values.word(
      "type",
      {"plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"},
      "sphere");
  const auto skip = [&](const std::string& what) {
    unused_types_.insert(type);
    cache_.warn(fmt::format("{}: geom: {}; it is not used", element.place(), what));
    return std::nullopt;
  };
  if ((type == "plane" && !of_world) || type == "hfield" || type == "sdf")
    return skip(of_world
                    ? fmt::format("no obstacle is made of a {} here", type)
                    : fmt::format("a {} is no part of a {} here", type, scene_ ? "body" : "robot"));
  MjcfGeom geom;
  if (scene_) {
    if (values.has("friction"))
      geom.friction.mu = document_.repairs().magnitude(values.numbers("friction", 1, 3)[0],
                                                       values.subject("friction"));
    if (const auto wrong = fault(friction_rule, geom.friction.mu); !wrong.empty())
      values.fail("friction", "{}", wrong);
    geom.friction.priority = values.integer("priority", 0);
    geom.friction.frictionless = values.integer("condim", 3) == 1;
  }
  geom.name = values.text("name", "");
  if (values.has("surfacevel"))
    cache_.warn(
        fmt::format("{}: geom '{}': surfacevel is not used; surface_velocity of its body "
                    "makes a conveyor",
                    element.place(), excerpt(geom.name)));
  geom.paired = !geom.name.empty() && paired_.contains(geom.name);
  geom.type = static_cast<unsigned>(values.integer("contype", 1));
  geom.affinity = static_cast<unsigned>(values.integer("conaffinity", 1));
  const int group = values.integer("group", 0);
  geom.drawn = group >= 0 && group <= 2;
  Pose X = document_.pose(values);
  if (type == "mesh" || (values.has("mesh") && !values.has("size") && !values.has("fromto"))) {
    if (type != "mesh")
      cache_.warn(fmt::format("{}: geom: a {} is to be fitted to a mesh; the mesh is used itself",
                              element.place(), type));
    geom.piece.geometry = mesh(values, geom.collides());
    if (!geom.piece.geometry) return {};
  } else if (type == "plane") {
    set_plane(values, geom);
  } else {
    set_primitive(type, values, geom, X);
  }
  geom.piece.X_LG = X_frame * X;
  geom.piece.color = color(values);
  const double volume = std::abs(solid_of(geom.piece).volume);
  geom.mass = values.has("mass")
                  ? values.not_negative("mass", 0, document_.repairs())
                  : values.not_negative("density", 1000, document_.repairs()) * volume;
  return geom;
}

}  // namespace clench
