#include "clench/io/mjcf_write/written_geoms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <optional>

#include "clench/base/hash.h"
#include "clench/base/text.h"
#include "clench/geometry/mesh/hull.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace {

// a surface with more parts is written as one mesh
constexpr size_t max_mesh_parts = 64;
// a hull whose volume is larger by at most this fraction is not reported
constexpr double hull_excess = 0.02;

Eigen::MatrixXd points_of(const Mesh& mesh) {
  Eigen::MatrixXd out(3, static_cast<Eigen::Index>(mesh.vertices.size()));
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    out.col(static_cast<Eigen::Index>(i)) = mesh.vertices[i];
  return out;
}

/// The triangles of `mesh` for which keep is true, with the vertices that they use.
template <class Keep>
Mesh kept_triangles(const Mesh& mesh, Keep keep) {
  Mesh out;
  std::vector<int> now(mesh.vertices.size(), -1);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!keep(static_cast<int>(t))) continue;
    Triangle triangle = mesh.triangles[t];
    for (int& v : triangle) {
      int& place = now[static_cast<size_t>(v)];
      if (place < 0) {
        place = static_cast<int>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[static_cast<size_t>(v)]);
      }
      v = place;
    }
    out.triangles.push_back(triangle);
  }
  return out;
}

/// Connected parts; vertices at the same position connect.
std::vector<Mesh> connected_parts(const Mesh& mesh) {
  std::vector<int> root(mesh.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[static_cast<size_t>(v)] != v) v = root[static_cast<size_t>(v)];
    return v;
  };
  const auto join = [&](int a, int b) {
    a = find(a), b = find(b);
    root[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
  };
  std::map<std::array<double, 3>, int> at;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto& p = mesh.vertices[v];
    join(at.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(v)).first->second,
         static_cast<int>(v));
  }
  for (const Triangle& t : mesh.triangles) join(t[0], t[1]), join(t[0], t[2]);
  std::map<int, int> number;
  std::vector<int> part;
  for (const Triangle& t : mesh.triangles)
    part.push_back(number.try_emplace(find(t[0]), static_cast<int>(number.size())).first->second);
  if (number.size() < 2 || number.size() > max_mesh_parts) return {mesh};
  std::vector<Mesh> out;
  for (int p = 0; p < static_cast<int>(number.size()); ++p)
    out.push_back(kept_triangles(mesh, [&](int t) { return part[static_cast<size_t>(t)] == p; }));
  return out;
}

uint64_t hash_of_mesh(const Mesh& mesh) {
  Hasher hash;
  for (const auto& p : mesh.vertices)
    for (int i = 0; i < 3; ++i) hash.add(p[i]);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) hash.add(static_cast<uint64_t>(v));
  return hash.value();
}

std::string plain_file_name(const std::string& name) {
  std::string out = name.substr(0, 80);
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return out;
}

// distinct corners of a mesh, at most 9
std::vector<Eigen::Vector3d> distinct_corners(const Mesh& mesh, double slack) {
  std::vector<Eigen::Vector3d> out;
  for (const auto& p : mesh.vertices) {
    const auto same = [&](const Eigen::Vector3d& q) { return (p - q).norm() < slack; };
    if (std::ranges::none_of(out, same)) out.push_back(p);
    if (out.size() > 8) break;
  }
  return out;
}

}  // namespace

std::optional<BoxFit> box_of(const Mesh& mesh) {
  if (mesh.vertices.size() < 8 || mesh.vertices.size() > 36 || !is_convex(mesh)) return {};
  const double slack = 1e-9 * mesh.bounds().size().norm();
  const auto corners = distinct_corners(mesh, slack);
  if (corners.size() != 8) return {};
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const auto& p : corners) center += p / 8;
  // the three edges from one corner that are nearest to orthogonal
  std::array<Eigen::Vector3d, 3> edges;
  size_t count = 0;
  std::vector<Eigen::Vector3d> from_first;
  for (size_t i = 1; i < 8; ++i) from_first.push_back(corners[i] - corners[0]);
  std::ranges::sort(from_first, {}, [](const Eigen::Vector3d& e) { return e.norm(); });
  for (const auto& e : from_first) {
    const auto is_across = [&](const Eigen::Vector3d& other) {
      return std::abs(e.dot(other)) < 1e-6 * e.norm() * other.norm();
    };
    if (count < 3 &&
        std::all_of(edges.begin(), edges.begin() + static_cast<long>(count), is_across))
      edges[count++] = e;
  }
  if (count < 3) return {};
  Eigen::Matrix3d R;
  BoxFit out;
  for (int i = 0; i < 3; ++i) {
    out.half[i] = 0.5 * edges[static_cast<size_t>(i)].norm();
    R.col(i) = edges[static_cast<size_t>(i)].normalized();
  }
  if (R.determinant() < 0) R.col(2) = -R.col(2);
  out.X_MB = Pose{Eigen::Quaterniond(R).normalized(), center};
  for (const auto& p : corners) {
    const Eigen::Vector3d q = out.X_MB.inverse() * p;
    if ((q.cwiseAbs() - out.half).cwiseAbs().maxCoeff() > 10 * slack + 1e-6 * out.half.maxCoeff())
      return {};
  }
  return out;
}

void SceneGeoms::push(const WrittenBody& body, WrittenGeom geom) {
  geom.name = unique_name(body.name, geom_names_);
  geoms_.back().push_back(std::move(geom));
}

void SceneGeoms::add_primitive(const WrittenBody& body, const std::string& type,
                               const std::string& size, const Pose& X_BG) {
  push(body, {.name = {}, .type = type, .size = size, .X_BG = X_BG});
}

void SceneGeoms::add_mesh(const WrittenBody& body, Mesh mesh, bool collides) {
  const auto [place, is_new] =
      by_hash_.try_emplace(hash_of_mesh(mesh), static_cast<int>(meshes_.size()));
  if (is_new) {
    const std::string name = unique_name(body.name, mesh_names_);
    const std::string stem = unique_name(plain_file_name(name), file_names_);
    meshes_.push_back({name, folder_ + stem + ".obj", std::move(mesh)});
  }
  push(body, {.name = {},
              .type = "mesh",
              .size = {},
              .mesh = place->second,
              .X_BG = {},
              .collides = collides});
}

void SceneGeoms::add_hull(const WrittenBody& body, const Mesh& mesh) {
  const Eigen::MatrixXd points = points_of(mesh);
  const Hull hull = convex_hull(points);
  if (!hull.full()) {
    flat_.push_back(body.name);
    return;
  }
  Mesh surface{mesh.vertices, hull_triangles(hull, points)};
  add_mesh(body, kept_triangles(surface, [](int) { return true; }), true);
}

// MuJoCo collides with the convex hull of each mesh, and rejects meshes without volume
void SceneGeoms::add_triangles(const WrittenBody& body, const Shape& shape) {
  if (!shape.has_volume()) {
    open_.push_back(body.name);
    return add_hull(body, shape.mesh());
  }
  double excess = 0, volume = 0;
  for (Mesh& part : connected_parts(shape.mesh())) {
    if (const auto box = box_of(part)) {
      add_primitive(body, "box",
                    fmt::format("{} {} {}", box->half.x(), box->half.y(), box->half.z()),
                    box->X_MB);
      continue;
    }
    const double own = solid_mass(part).volume;
    const Hull hull = convex_hull(points_of(part));
    if (!hull.full() || !(own > 1e-3 * hull.volume)) {
      // a cavity, or a sheet
      add_hull(body, part);
      if (hull.full()) excess += hull.volume;
      continue;
    }
    volume += own;
    excess += hull.volume - own;
    add_mesh(body, std::move(part), true);
  }
  if (excess > hull_excess * volume) concave_.push_back(body.name);
}

void SceneGeoms::add_surface(const WrittenBody& body, const Shape& shape) {
  std::vector<char> is_round(shape.mesh().triangles.size());
  for (const RoundPiece& piece : shape.rounds().pieces) {
    for (int t = piece.first; t < piece.first + piece.count; ++t)
      is_round[static_cast<size_t>(t)] = true;
    const Round& solid = piece.solid;
    const Eigen::Vector3d& r = solid.radii;
    if (solid.kind == Round::ellipsoid)
      add_primitive(body, "ellipsoid", fmt::format("{} {} {}", r.x(), r.y(), r.z()), piece.X_SR);
    else if (solid.is_ball())
      add_primitive(body, "sphere", fmt::format("{}", r.x()), piece.X_SR);
    else
      add_primitive(body, solid.kind == Round::capsule ? "capsule" : "cylinder",
                    fmt::format("{} {}", r.x(), solid.half), piece.X_SR);
  }
  if (shape.rounds().pieces.empty()) return add_triangles(body, shape);
  if (shape.facets()) add_triangles(body, *shape.facets());
}

void SceneGeoms::add(const WrittenBody& body) {
  geoms_.emplace_back();
  if (body.spec->shape) add_surface(body, *body.spec->shape);
  const ShapePtr& drawn = body.spec->appearance.visual;
  if (!drawn) return;
  if (convex_hull(points_of(drawn->mesh())).full())
    add_mesh(body, drawn->mesh(), false);
  else
    flat_.push_back(body.name);
}

std::vector<std::string> SceneGeoms::losses() const {
  std::vector<std::string> out;
  const auto tell = [&](const std::vector<std::string>& names, const char* sentence) {
    if (!names.empty()) out.push_back(fmt::format("{}: {}", sentence, some_names(names)));
  };
  tell(concave_,
       "MuJoCo collides with the convex hull of each mesh, and these bodies have hollows that it "
       "fills");
  tell(open_, "surfaces that enclose no volume are written as their convex hull");
  tell(flat_, "flat surfaces, which MuJoCo cannot load, are not written");
  return out;
}

}  // namespace clench
