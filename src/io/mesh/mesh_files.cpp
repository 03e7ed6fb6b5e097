#include "clench/io/mesh/mesh_files.h"

#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/geometry/mesh/hull.h"
#include "clench/io/mesh/mesh_readers.h"

namespace clench {

double guess_mesh_unit(double largest_side) {
  // Mesh files are in meters (robots, games) or in millimeters (machines, scanners, printers).
  // Objects of grasping and their surroundings measure between 1 cm (a nut) and 10 m (a room). Of
  // the two units we choose the one whose size is nearer, as a ratio, to the geometric mean of this
  // range, 0.32 m: meters up to 10 units.
  constexpr double max_meters = 10;
  return largest_side <= max_meters ? 1 : units::millimeter;
}

static void set_unit(GeometryBuilder& builder, const std::string& file,
                     const ReadOptions& options) {
  MeshReport& report = builder.report;
  const bool silent = report.unit_source == UnitSource::guess;
  if (options.mesh_scale) {
    report.unit = *options.mesh_scale;
    report.unit_source = UnitSource::option;
  } else if (silent && options.silent_mesh_unit) {
    report.unit = *options.silent_mesh_unit;
    report.unit_source = UnitSource::format;
  } else if (silent) {
    const Eigen::Vector3d size = builder.bounds().size();
    report.unit = guess_mesh_unit(size.maxCoeff());
    options.diagnostics.note(Place(file),
                             "it names no unit; its size, {:.4g} x {:.4g} x {:.4g}, is taken for "
                             "{} (the option unit overrides this)",
                             size.x(), size.y(), size.z(), unit_name(report.unit));
  }
}

/// Rotation that turns the file's up axis to z and its front to -y.
static Eigen::Matrix3d turn_up(char up) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (up == 'y') turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == 'x') turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return turn;
}

/// returns  true if colors come from the file
static bool read_triangles(const MeshInput& input, GeometryBuilder& builder) {
  const std::string ending = ending_of(input.path);
  const bool given = input.format != GeometryFormat::none;
  switch (given ? input.format : geometry_format(ending)) {
    case GeometryFormat::obj:
      return read_obj(input, builder);
    case GeometryFormat::ply:
      return read_ply(input, builder);
    case GeometryFormat::off:
      return read_off(input, builder);
    case GeometryFormat::collada:
      return read_collada(input, builder);
    case GeometryFormat::gltf:
      return read_gltf(input, builder);
    case GeometryFormat::stl:
      return read_stl(input, builder);
    case GeometryFormat::none:
    case GeometryFormat::inventor:
      break;
  }
  std::vector<std::string> expected = geometry_endings();
  std::erase_if(expected, [](const auto& e) { return is_inventor(e); });
  fail("{}: expected a mesh from {}, got {}", input.file(), one_of(expected), in_quotes(ending));
}

/// Adds the faces of the convex hull of all vertices, which must span a solid.
static void add_hull(const std::string& file, GeometryBuilder& builder) {
  constexpr size_t max_points = 1'000'000;  // the cost of a hull may be quadratic
  if (builder.vertex_count() > max_points)
    fail("{}: expected triangles, or at most {} points, got {} points", file, max_points,
         builder.vertex_count());
  Eigen::MatrixXd points(3, builder.vertex_count());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = builder.vertex(static_cast<int>(i));
  const Hull hull = convex_hull(points);
  if (!hull.full()) fail("{}: expected triangles, or points that span a solid", file);
  const Appearance plain;
  for (const Triangle& triangle : hull_triangles(hull, points))
    builder.add_face(triangle, plain.color, plain.transparency);
}

Geometry read_mesh(const MeshInput& input) {
  const ReadOptions& options = input.options;
  const std::string file = input.file();
  GeometryBuilder builder;
  builder.progress = options.progress;
  builder.limit_to(input.bytes.size());
  builder.report.unit_source = UnitSource::guess;  // unless the file names a unit
  const bool colors_given = read_triangles(input, builder);
  if (builder.triangle_count() == 0 && input.bare_points == BarePoints::hull &&
      builder.vertex_count() > 3)
    add_hull(file, builder);
  if (builder.triangle_count() == 0) fail("{}: expected triangles, got none", file);
  set_unit(builder, file, options);
  MeshReport& report = builder.report;
  if (!options.turn_mesh_up) report.up = 'z';
  if (report.up != 'z')
    options.diagnostics.note(Place(file), "its {} axis is up, and was turned to z", report.up);
  builder.transform(report.unit, turn_up(report.up));
  return builder.finish(colors_given, file, options);
}

Geometry read_mesh_file(const std::filesystem::path& path, const ReadOptions& options,
                        GeometryFormat format, BarePoints bare_points) {
  const std::string bytes = read_bytes(path);
  return read_mesh({path, bytes, options, format, bare_points});
}

}  // namespace clench
