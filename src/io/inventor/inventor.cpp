#include "clench/io/inventor/inventor.h"

#include "clench/base/error.h"
#include "clench/base/units.h"
#include "clench/io/inventor/inventor_faces.h"

namespace clench {

namespace {

constexpr int max_inventor_triangles = 2'000'000;

/// Collects the triangles of one shape.
class ShapeTriangles {
 public:
  ShapeTriangles(const InventorNode& shape, const InventorState& state, double unit,
                 GeometryBuilder& builder)
      : shape_(shape), state_(state), unit_(unit), builder_(builder) {
    surface_.add = [this](std::span<const InventorVector> face, int color) { add(face, color); };
  }

  /// returns  true if it is a shape that has triangles
  bool gather() {
    return list_faces(shape_, state_, surface_) || cut_shape(shape_, state_, surface_);
  }
  bool has_colors() const { return !surface_.colors.empty(); }

 private:
  void add(std::span<const InventorVector> face, int color);
  void add_triangle(const std::array<InventorVector, 3>& corners, int color);

  const InventorNode& shape_;
  const InventorState& state_;
  double unit_;  // [m]
  GeometryBuilder& builder_;
  InventorSurface surface_;
  std::vector<Eigen::Vector3d> corners_;
};

void ShapeTriangles::add(std::span<const InventorVector> face, int color) {
  if (face.size() == 3) return add_triangle({face[0], face[1], face[2]}, color);
  corners_.clear();
  for (const auto& p : face) corners_.emplace_back(p[0], p[1], p[2]);
  for (const auto& t : builder_.cut(corners_, surface_.convex))
    add_triangle({face[t[0]], face[t[1]], face[t[2]]}, color);
}

void ShapeTriangles::add_triangle(const std::array<InventorVector, 3>& corners, int color) {
  // dropped triangles count, too, because they take the same time
  if (builder_.report.triangles_read >= max_inventor_triangles)
    fail("expected at most {} triangles", max_inventor_triangles);
  std::array<Eigen::Vector3d, 3> points;
  for (int i = 0; i < 3; ++i) {
    const InventorVector p = state_.X.apply(corners[i]);
    points[i] = Eigen::Vector3d(p[0], p[1], p[2]) * unit_;
    if (!points[i].allFinite())
      fail("{}: expected finite coordinates, got ({}, {}, {})", shape_.type->name, p[0], p[1],
           p[2]);
  }
  // a mirrored shape is inside out
  if (surface_.clockwise != state_.X.mirrors()) std::swap(points[1], points[2]);

  const auto& own = surface_.colors;
  const Eigen::Vector3f given = own.empty()
                                    ? state_.color(color)
                                    : own[std::clamp(color, 0, static_cast<int>(own.size()) - 1)];
  builder_.add(points, given.cwiseMax(0.0f).cwiseMin(1.0f),
               std::clamp(state_.alpha(color), 0.0f, 1.0f), shape_.file == 0 ? shape_.line : 0);
}

}  // namespace

Geometry read_inventor(const std::filesystem::path& path, const std::string& text,
                       const ReadOptions& options) {
  const std::string file = path.filename().string();
  const double unit = options.mesh_scale.value_or(units::millimeter);
  GeometryBuilder builder;
  builder.progress = options.progress;
  builder.keeps_triangles = true;
  MeshReport& report = builder.report;
  report.format = text.starts_with("#VRML") ? "VRML" : "Inventor";
  report.unit = unit;
  report.unit_source = options.mesh_scale ? UnitSource::option : UnitSource::format;

  const InventorGraph graph = read_inventor_graph(path, text, options);
  builder.limit_to(graph.bytes);
  bool own_colors = false;
  InventorWalk walk;
  walk.shape = [&](const InventorNode& shape, const InventorState& state) {
    ShapeTriangles triangles(shape, state, unit, builder);
    if (!triangles.gather() && shape.type->kind == InventorKind::odd_shape)
      walk.warnings.add(file, Diagnostic(Place(file), fmt::format("{} is not used as geometry",
                                                                  shape.type->name)));
    own_colors = own_colors || triangles.has_colors();
  };
  walk_inventor(graph, {}, walk);
  tell_inventor_warnings(graph, walk, options);
  for (const auto& named : walk.units)
    options.diagnostics.note(Place(file),
                             "Units {} scales the nodes after it by its length relative to METERS, "
                             "or to the Units before it",
                             named);
  return builder.finish(walk.colors_given || own_colors, file, options);
}

}  // namespace clench
