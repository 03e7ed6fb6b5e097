#include "clench/io/tree/tree_geometry.h"

#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/io/inventor/read_geometry.h"
#include "clench/io/mesh/mesh_files.h"
#include "clench/io/text/file_cache.h"
#include "clench/io/tree/tree_shapes.h"

namespace clench {

// a round shape takes about 60 bytes of a file, and a triangle about 150 of memory
static constexpr size_t max_round_triangles = 500'000;
static constexpr size_t max_image_bytes = size_t{1} << 30;

TreeGeometry::TreeGeometry(const ReadOptions& options, BarePoints bare_points)
    : options_(options), bare_points_(bare_points) {
  // robot files use meters, and place meshes without turning their axes
  options_.silent_mesh_unit = 1;
  options_.turn_mesh_up = false;
}

std::shared_ptr<const Geometry> TreeGeometry::file(const std::filesystem::path& path) {
  auto& found = geometries_["file " + path.string()];
  if (found) return found;
  ReadOptions options = options_;
  // VRML files of robots use meters, too
  if (is_inventor(path) && !options.mesh_scale) options.mesh_scale = 1;
  const bool points = bare_points_ == BarePoints::hull && !is_inventor(path);
  return found = std::make_shared<const Geometry>(
             points ? read_mesh_file(path, options, GeometryFormat::none, bare_points_)
                    : read_geometry(path, options));
}

std::shared_ptr<const Geometry> TreeGeometry::made(const std::string& name, Mesh mesh) {
  auto& found = geometries_[name];
  if (found) return found;
  Geometry geometry;
  geometry.mesh = std::move(mesh);
  return found = std::make_shared<const Geometry>(std::move(geometry));
}

GeometryPiece TreeGeometry::primitive(const std::string& kind, const std::vector<double>& sizes) {
  GeometryPiece out;
  Mesh mesh;
  if (kind == "box") {
    mesh = box_mesh({sizes[0], sizes[1], sizes[2]});
  } else if (kind == "ellipsoid") {
    mesh = ellipsoid_mesh({sizes[0], sizes[1], sizes[2]});
    out.solid = ellipsoid_solid({sizes[0], sizes[1], sizes[2]});
    out.round = Round::ellipsoid_of({sizes[0], sizes[1], sizes[2]});
  } else if (kind == "cylinder") {
    mesh = cylinder_mesh(sizes[0], sizes[1]);
    out.solid = cylinder_solid(sizes[0], sizes[1]);
    out.round = Round::cylinder_of(sizes[0], sizes[1]);
  } else {
    const double length = kind == "sphere" ? 0 : sizes[1];
    mesh = capsule_mesh(sizes[0], length);
    out.solid = capsule_solid(sizes[0], length);
    out.round = Round::capsule_of(sizes[0], length);
  }
  std::string name = kind;
  for (const double size : sizes) name += fmt::format(" {}", size);
  out.geometry = made(name, std::move(mesh));
  return out;
}

MassProperties solid_of(const GeometryPiece& piece) {
  return piece.solid ? *piece.solid : solid_mass(piece.geometry->mesh);
}

/// Equal for pieces that make equal shapes.
static std::string key_of(const std::vector<GeometryPiece>& pieces) {
  std::string key;
  for (const GeometryPiece& piece : pieces) {
    key += fmt::format("{}", static_cast<const void*>(piece.geometry.get()));
    for (const double x : piece.scale) key += fmt::format(" {}", x);
    for (const double x : piece.X_LG.position) key += fmt::format(" {}", x);
    for (const double x : piece.X_LG.rotation.coeffs()) key += fmt::format(" {}", x);
    if (piece.color)
      key += fmt::format(" #{} {} {} {}", piece.color->color.x(), piece.color->color.y(),
                         piece.color->color.z(), piece.color->transparency);
    if (piece.skin) key += fmt::format(" @{}", static_cast<const void*>(piece.skin.get()));
    key += ';';
  }
  return key;
}

static void append(Mesh& mesh, std::vector<Eigen::Vector3f>& colors, const GeometryPiece& piece) {
  const Geometry& geometry = *piece.geometry;
  const int first = static_cast<int>(mesh.vertices.size());
  for (const auto& p : geometry.mesh.vertices)
    mesh.vertices.push_back(piece.X_LG * p.cwiseProduct(piece.scale));
  // a mirrored mesh would face inward
  const bool mirrored = piece.scale.prod() < 0;
  for (const auto& t : geometry.mesh.triangles)
    mesh.triangles.push_back(
        {first + t[0], first + t[mirrored ? 2 : 1], first + t[mirrored ? 1 : 2]});
  const Appearance& looks = geometry.appearance;
  for (size_t i = 0; i < geometry.mesh.triangles.size(); ++i)
    colors.push_back(piece.color                     ? piece.color->color
                     : looks.triangle_colors.empty() ? looks.color
                                                     : looks.triangle_colors[i]);
}

static SkinPtr skin_of(const GeometryPiece& piece) {
  const bool own = piece.skin || piece.color;
  const SkinPtr& skin = own ? piece.skin : piece.geometry->appearance.skin;
  return piece.scale.prod() < 0 ? turned_over(skin) : skin;
}

SkinPtr TreeGeometry::skin_of_all(const std::vector<GeometryPiece>& pieces, const Place& subject) {
  Skin out;
  for (const GeometryPiece& piece : pieces)
    append_skin(out, skin_of(piece), piece.geometry->mesh.triangles.size());
  size_t bytes = 0;
  for (const Texture& texture : out.textures)
    if (images_.insert(texture.image).second) bytes += texture.image->pixels.size();
  if (out.textures.empty()) return nullptr;
  image_bytes_ += bytes;
  if (image_bytes_ > max_image_bytes) {
    if (image_bytes_ - bytes <= max_image_bytes)
      options_.diagnostics.warn(subject,
                                "expected textures of at most {} MB in all links; from here on "
                                "links have colors instead",
                                max_image_bytes >> 20);
    return nullptr;
  }
  return std::make_shared<const Skin>(std::move(out));
}

static Appearance looks_of(const std::vector<GeometryPiece>& pieces,
                           std::vector<Eigen::Vector3f> colors) {
  Appearance out;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  bool differ = false;
  for (const auto& c : colors) {
    sum += c;
    differ = differ || c != colors.front();
  }
  for (const GeometryPiece& piece : pieces) {
    const Appearance& looks = piece.geometry->appearance;
    out.given = out.given || piece.color || looks.given;
    // a body has one transparency: the smallest, so that no opaque piece vanishes
    const float t = piece.color ? piece.color->transparency : looks.transparency;
    out.transparency = &piece == &pieces.front() ? t : std::min(out.transparency, t);
  }
  if (!out.given || colors.empty()) return out;
  out.color = differ ? Eigen::Vector3f((sum / static_cast<float>(colors.size())).cwiseMin(1.0f))
                     : colors.front();
  if (differ) out.triangle_colors = std::move(colors);
  return out;
}

// All pairs of round pieces of two bodies are tested; bodies with more pieces collide as triangles.
static constexpr size_t max_round_pieces = 64;

static RoundPieces rounds_of(const std::vector<GeometryPiece>& pieces) {
  RoundPieces out;
  int first = 0;
  for (const GeometryPiece& piece : pieces) {
    const int count = static_cast<int>(piece.geometry->mesh.triangles.size());
    if (piece.round && piece.scale == Eigen::Vector3d::Ones())
      out.pieces.push_back(
          {.solid = *piece.round, .X_SR = piece.X_LG, .first = first, .count = count});
    first += count;
  }
  return out;
}

TreeGeometry::Body TreeGeometry::merge(const std::vector<GeometryPiece>& pieces,
                                       const Place& subject) {
  if (pieces.empty()) return {};
  const std::string key = key_of(pieces);
  if (const auto found = bodies_.find(key); found != bodies_.end()) return found->second;

  size_t vertices = 0, triangles = 0;
  for (const GeometryPiece& piece : pieces) {
    check_stop();
    const Mesh& part = piece.geometry->mesh;
    vertices += part.vertices.size();
    triangles += part.triangles.size();
    triangles_ += part.triangles.size();
    if (piece.solid) round_triangles_ += part.triangles.size();
    if (triangles_ > max_mesh_triangles)
      fail("{}: expected at most {} triangles in all links", subject, max_mesh_triangles);
    if (round_triangles_ > max_round_triangles)
      fail(
          "{}: expected at most {} triangles in the spheres, capsules, cylinders and ellipsoids of "
          "all links, a thousand in each sphere",
          subject, max_round_triangles);
  }
  Mesh mesh;
  std::vector<Eigen::Vector3f> colors;
  mesh.vertices.reserve(vertices);
  mesh.triangles.reserve(triangles);
  colors.reserve(triangles);
  for (const GeometryPiece& piece : pieces) {
    check_stop();
    append(mesh, colors, piece);
  }
  Body body;
  RoundPieces rounds = rounds_of(pieces);
  if (rounds.pieces.size() > max_round_pieces) {
    options_.diagnostics.note(
        subject, "its {} round shapes collide as triangle meshes, because there are more than {}",
        rounds.pieces.size(), max_round_pieces);
    rounds = {};
  }
  body.shape = Shape::make(std::move(mesh), subject.text(), {}, std::move(rounds));
  body.appearance = looks_of(pieces, std::move(colors));
  if (body.appearance.given) body.appearance.skin = skin_of_all(pieces, subject);
  if (pieces.size() == 1 && !pieces[0].geometry->report.format.empty())
    body.report = pieces[0].geometry->report;
  bodies_.emplace(key, body);
  return body;
}

}  // namespace clench
