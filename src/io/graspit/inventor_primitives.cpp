#include "clench/io/graspit/inventor_primitives.h"
#include "clench/io/text/file_errors.h"

#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/io/graspit/body_xml.h"
#include "clench/io/inventor/inventor_walk.h"

namespace clench {

namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr int max_primitive_visits = 100'000;  // of nodes, shared ones each time
constexpr size_t max_found = 10'000;           // primitives
constexpr double digits =
    1e-4;  // matrices of scene graphs have six digits, and several are multiplied

/// A primitive in its own frame, in millimeters.
struct Solid {
  PrimitiveKind kind;
  Vector3d size = Vector3d::Zero();
  double radius = 0, height = 0;
};

std::optional<Solid> primitive_of(const InventorNode& node) {
  using Kind = PrimitiveKind;
  switch (node.type->kind) {
    case InventorKind::cube:
      if (node.type->name == "Cube")
        return Solid{
            .kind = Kind::box,
            .size = Vector3d(node.number("width"), node.number("height"), node.number("depth"))};
      return Solid{.kind = Kind::box,
                   .size = Eigen::Vector3f(node.numbers("size").data()).cast<double>()};
    case InventorKind::sphere:
      return Solid{.kind = Kind::sphere, .radius = node.number("radius")};
    case InventorKind::cylinder:
      return Solid{
          .kind = Kind::cylinder, .radius = node.number("radius"), .height = node.number("height")};
    case InventorKind::cone:
      return Solid{.kind = Kind::cone,
                   .radius = node.number("bottomRadius"),
                   .height = node.number("height")};
    default:
      return {};
  }
}

const char* name_of(PrimitiveKind kind) {
  static constexpr const char* names[] = {"box", "sphere", "cylinder", "cone"};
  return names[static_cast<int>(kind)];
}

Primitive placed(const Solid& shape, const InventorMatrix& X, const std::string& file,
                 InventorWarnings& warnings) {
  const char* name = name_of(shape.kind);
  const bool box = shape.kind == PrimitiveKind::box, ball = shape.kind == PrimitiveKind::sphere;
  const double least =
      box ? shape.size.minCoeff() : std::min(shape.radius, ball ? shape.radius : shape.height);
  if (!(least > 0)) fail("{}: expected sizes > 0, got {}", name, least);

  // rotation and scale of each axis; row vectors are multiplied
  Matrix3d axes;
  Vector3d position;
  for (int i = 0; i < 3; ++i) {
    position[i] = X.m[3][i];
    for (int j = 0; j < 3; ++j) axes(j, i) = X.m[i][j];
  }
  const Vector3d scale = axes.colwise().norm();
  if (!axes.allFinite() || !position.allFinite() || !(scale.minCoeff() > 0))
    fail("{}: expected a finite scale other than 0", name);
  axes = axes * scale.cwiseInverse().asDiagonal();
  if ((axes.transpose() * axes - Matrix3d::Identity()).cwiseAbs().maxCoeff() > digits)
    fail("{}: it is skewed, and thus no primitive", name);
  if (axes.determinant() < 0) axes.col(0) *= -1;  // all primitives are mirror-symmetric
  const double across = std::max(scale.x(), scale.z());
  const bool oval = ball ? scale.maxCoeff() - scale.minCoeff() > digits * scale.maxCoeff()
                         : std::abs(scale.x() - scale.z()) > digits * across;
  if (!box && oval)
    warnings.add(file, fmt::format("{}: {}: it is oval; the largest radius is used", file, name));

  Primitive out{.kind = shape.kind,
                .X_OP = {Eigen::Quaterniond(axes).normalized(), position * units::millimeter}};
  out.size = shape.size.cwiseProduct(scale) * units::millimeter;
  out.radius = shape.radius * (ball ? scale.maxCoeff() : across) * units::millimeter;
  out.height = shape.height * scale.y() * units::millimeter;
  return out;
}

/// The file named by an XML body; with an empty path and a warning if it names none.
PlacedFile geometry_of_body(const fs::path& path, const ReadOptions& options) {
  const XmlFile body(path);
  check_body_root(body);
  const auto found = read_placed_file(body.root(), path, options);
  if (!found) options.diagnostics.warn(body.root().place(), "no <geometryFile>: no primitives");
  return found.value_or(PlacedFile());
}

/// Transform from millimeters to millimeters, for row vectors.
InventorMatrix placement_of(const PlacedFile& file) {
  const Pose X_BG = file.X_BG.value_or(Pose{});
  const Matrix3d axes = X_BG.rotation.toRotationMatrix() * file.scaling.asDiagonal();
  InventorMatrix X;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X.m[i][j] = static_cast<float>(axes(j, i));
    X.m[3][i] = static_cast<float>(X_BG.position[i] / units::millimeter);
  }
  return X;
}

}  // namespace

std::vector<Primitive> read_primitives(const fs::path& path, const ReadOptions& options) {
  return of_file([&]() -> std::vector<Primitive> {
    // a simplified version prepared by the user
    const fs::path beside =
        path.parent_path() / "primitives" / fs::path(path.filename()).replace_extension(".iv");
    PlacedFile source{.path = path};
    if (is_readable(beside, options))
      source.path = beside;
    else if (ending_of(path) == ".xml")
      source = geometry_of_body(path, options);
    if (source.path.empty()) return {};
    const std::string file = source.path.filename().string(), ending = ending_of(source.path);
    if (source.format == GeometryFormat::none) source.format = geometry_format(ending);
    if (source.format != GeometryFormat::inventor)
      fail("{}: expected primitives from {}, got {}", file,
           one_of(endings_of(GeometryFormat::inventor)), in_quotes(ending));

    std::vector<Primitive> found;
    const InventorGraph graph = read_inventor_graph(source.path, read_text(source.path), options);
    InventorWalk walk;
    walk.max_visits = max_primitive_visits;
    walk.shape = [&](const InventorNode& shape, const InventorState& state) {
      if (found.size() >= max_found) fail("expected at most {} primitives", max_found);
      if (const auto solid = primitive_of(shape))
        found.push_back(placed(*solid, state.X, file, walk.warnings));
      else
        walk.warnings.add(
            file, fmt::format("{}: {} is no primitive and is not used", file, shape.type->name));
    };
    InventorState start;
    start.X = placement_of(source);
    walk_inventor(graph, start, walk);
    tell_inventor_warnings(graph, walk, options);
    return found;
  });
}

}  // namespace clench
