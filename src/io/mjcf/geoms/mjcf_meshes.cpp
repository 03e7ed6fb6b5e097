#include "clench/io/mjcf/geoms/mjcf_meshes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clench/base/convert.h"
#include "clench/base/suggest.h"
#include "clench/geometry/mesh/hull.h"
#include "clench/io/mjcf/geoms/mjcf_builtin.h"

namespace clench {

static constexpr int max_mesh_numbers = 3'000'000;  // of vertices or faces in the model

void MjcfMeshes::add(const XmlElement& element) {
  const XmlValues values = document_.values(element);
  std::string name = values.text("name", "");
  if (name.empty()) name = std::filesystem::path(values.text("file")).stem().string();
  if (!assets_.emplace(name, Asset{values}).second)
    document_.repairs().add("mesh", element.place().of("mesh"),
                            "there is another one of the name '{}'; the first one counts",
                            excerpt(name));
  document_.unused().attributes(
      element, {"name", "class", "file", "scale", "refpos", "refquat", "vertex", "face",
                "content_type", "inertia", "builtin", "params", "material"});
}

// --- shapes ---

/// Triangles of the convex hull, for a mesh of points without faces.
static Mesh with_hull(Mesh mesh, const XmlValues& values, const char* attribute) {
  if (!mesh.triangles.empty()) return mesh;
  Eigen::MatrixXd points(3, mesh.vertices.size());
  for (size_t i = 0; i < mesh.vertices.size(); ++i) points.col(i) = mesh.vertices[i];
  const Hull hull = convex_hull(points);
  if (!hull.full()) values.fail(attribute, "expected points that span a solid");
  mesh.triangles = hull_triangles(hull, points);
  return mesh;
}

/// A mesh given in the model; points without faces represent their convex hull.
Mesh MjcfMeshes::own_points(const XmlValues& values) const {
  const auto numbers = values.numbers("vertex", 12, max_mesh_numbers);
  if (numbers.size() % 3 != 0)
    values.fail("vertex", "expected three numbers for each vertex, got {}", numbers.size());
  Mesh mesh;
  for (size_t i = 0; i < numbers.size(); i += 3)
    mesh.vertices.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  const int count = static_cast<int>(mesh.vertices.size());
  if (!values.has("face")) return with_hull(std::move(mesh), values, "vertex");
  const auto faces = values.numbers("face", 3, max_mesh_numbers);
  if (faces.size() % 3 != 0)
    values.fail("face", "expected three vertices for each face, got {}", faces.size());
  for (size_t i = 0; i < faces.size(); i += 3) {
    for (int k = 0; k < 3; ++k)
      if (!(faces[i + k] >= 0 && faces[i + k] < count) || faces[i + k] != std::floor(faces[i + k]))
        values.fail("face", "expected vertices from 0 to {}, got {}", count - 1, faces[i + k]);
    mesh.triangles.push_back(
        {floor_int(faces[i]), floor_int(faces[i + 1]), floor_int(faces[i + 2])});
  }
  return mesh;
}

// a built-in mesh takes about 60 bytes of a file, and a triangle about 200 of memory
static constexpr size_t max_builtin_triangles = 500'000;

std::shared_ptr<const Geometry> MjcfMeshes::shape(const Asset& asset) {
  const XmlValues& values = asset.values;
  const std::string kind = values.text("builtin", "none");
  if (kind == "none" && !values.has("vertex"))
    return geometry_.file(document_.mesh_file(values, cache_.options()));
  Geometry geometry;
  if (kind == "none") {
    geometry.mesh = own_points(values);
  } else {
    const auto params = values.numbers("params", 0, 10);
    try {
      geometry.mesh = builtin_mesh(kind, params);
    } catch (const Error& error) {
      values.fail("builtin", "{}", error.what());
    }
    geometry.mesh = with_hull(std::move(geometry.mesh), values, "builtin");
    builtin_triangles_ += geometry.mesh.triangles.size();
    if (builtin_triangles_ > max_builtin_triangles)
      values.fail("builtin", "expected at most {} triangles in all built-in meshes",
                  max_builtin_triangles);
  }
  return std::make_shared<const Geometry>(std::move(geometry));
}

static MeshInertia inertia_rule(const XmlValues& values) {
  const std::string word = values.word("inertia", {"convex", "exact", "legacy", "shell"}, "legacy");
  return word == "convex"  ? MeshInertia::convex
         : word == "exact" ? MeshInertia::exact
         : word == "shell" ? MeshInertia::shell
                           : MeshInertia::legacy;
}

/// Removes the reference frame, then scales the mesh along its axes.
const MjcfMesh& MjcfMeshes::read(Asset& asset) {
  if (asset.mesh) return *asset.mesh;
  const XmlValues& values = asset.values;
  auto geometry = shape(asset);
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
  if (values.has("scale") || values.has("refpos") || values.has("refquat")) {
    Geometry moved = *geometry;
    for (auto& p : moved.mesh.vertices) p = (turn.conjugate() * (p - origin)).cwiseProduct(scale);
    if (scale.prod() < 0) {
      for (auto& t : moved.mesh.triangles) std::swap(t[1], t[2]);
      moved.appearance.skin = turned_over(moved.appearance.skin);
      moved.places = turned_over(moved.places);
    }
    geometry = std::make_shared<const Geometry>(std::move(moved));
  }
  MjcfMesh out;
  out.mass = mesh_mass(geometry->mesh, inertia_rule(values));
  out.geometry = std::move(geometry);
  out.material = values.text("material", "");
  asset.mesh = std::move(out);
  return *asset.mesh;
}

const MjcfMesh* MjcfMeshes::find(const XmlValues& geom, bool collides) {
  const std::string name = geom.text("mesh");
  const auto found = assets_.find(name);
  if (found == assets_.end())
    geom.fail("mesh", "no mesh {}{}", in_quotes(name), did_you_mean(name, names_in(assets_)));
  Asset& asset = found->second;
  try {
    return &read(asset);
  } catch (const Error& error) {
    Place place = asset.values.element().place();
    std::string what = error.what();
    if (const std::string before = place.text() + ": "; what.starts_with(before))
      what.erase(0, before.size());
    else
      place = place.of("mesh");
    if (collides) throw PlacedError(place, what);
    if (!std::exchange(asset.is_missing, true))
      cache_.diagnostics().warn(place, "{}; it is not drawn", what);
    return nullptr;
  }
}

// --- fitted primitives ---

/// Half edges of the box of uniform density that has the same moments per mass.
static Eigen::Vector3d inertia_box(const Eigen::Vector3d& moments) {
  const double sum = moments.sum();
  return (1.5 * (Eigen::Vector3d::Constant(sum) - 2 * moments)).cwiseMax(0).cwiseSqrt();
}

static std::vector<double> size_of_box(const std::string& type, const Eigen::Vector3d& b) {
  if (type == "sphere") return {b.sum() / 3};
  const double radius = (b.x() + b.y()) / 2;
  if (type == "capsule") return {radius, std::max(0.0, b.z() - radius / 2)};
  if (type == "cylinder") return {radius, b.z()};
  return {b.x(), b.y(), b.z()};
}

/// The smallest primitive whose bounding box contains the box of half edges h.
static std::vector<double> size_of_bounds(const std::string& type, const Eigen::Vector3d& h) {
  if (type == "sphere") return {h.maxCoeff()};
  const double radius = std::max(h.x(), h.y());
  if (type == "capsule") return {radius, std::max(0.0, h.z() - radius)};
  if (type == "cylinder") return {radius, h.z()};
  return {h.x(), h.y(), h.z()};
}

FittedPrimitive MjcfMeshes::fit(const MjcfMesh& mesh, const std::string& type,
                                const XmlValues& geom) const {
  const InertiaAxes axes = inertia_axes(mesh.mass.inertia);
  FittedPrimitive out;
  out.X_MF = {axes.rotation, mesh.mass.centroid};
  if (document_.settings(geom.element()).fit_bounds) {
    const Pose X_FM = out.X_MF.inverse();
    Eigen::Vector3d low = X_FM * mesh.geometry->mesh.vertices.front(), high = low;
    for (const auto& p : mesh.geometry->mesh.vertices) {
      low = low.cwiseMin(X_FM * p);
      high = high.cwiseMax(X_FM * p);
    }
    out.X_MF = out.X_MF * Pose::translation((low + high) / 2);
    out.size = size_of_bounds(type, (high - low) / 2);
  } else {
    out.size = size_of_box(type, inertia_box(axes.moments));
  }
  for (double& length : out.size) length *= geom.number("fitscale", 1);
  return out;
}

}  // namespace clench
