#include "io/geometry_builder.h"

#include <Eigen/Geometry>
#include <cmath>

namespace clench {

void GeometryBuilder::add(const std::array<Eigen::Vector3d, 3>& corners,
                          const Eigen::Vector3f& color, float transparency) {
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
  const int first = static_cast<int>(mesh_.vertices.size());
  mesh_.vertices.insert(mesh_.vertices.end(), corners.begin(), corners.end());
  mesh_.triangles.push_back({first, first + 1, first + 2});
  colors_.push_back(color);

  // the whole body's colour is the mean over its area
  const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
  if (!std::isfinite(area)) return;
  weighted_color_ += area * color.cast<double>();
  weighted_transparency_ += area * transparency;
  weight_ += area;
}

/// Seams of round shapes end in points that differ in their last bits: joins them where that mends
/// edges. The tolerance is a few units in the last place of the 32-bit numbers that the points
/// were.
static Mesh weld_seams(const Mesh& loose) {
  Mesh exact = weld(loose);
  const int open_edges = find_faults(exact).open_edges;
  if (open_edges == 0) return exact;
  const Bounds bounds = exact.bounds();
  const double largest =
      std::max(bounds.low.cwiseAbs().maxCoeff(), bounds.high.cwiseAbs().maxCoeff());
  int dropped = 0;
  Mesh joined = weld(exact, 4e-7 * largest, &dropped);
  return dropped == 0 && find_faults(joined).open_edges < open_edges ? joined : exact;
}

static void turn_if_inside_out(Mesh& mesh, const std::string& subject, const ReadOptions& options) {
  if (!(solid_mass(mesh).volume < 0) || !find_faults(mesh).closed()) return;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  if (options.warn) options.warn(subject + ": its triangles face inward; turned to face outward");
}

Geometry GeometryBuilder::finish(bool colors_given, const std::string& subject,
                                 const ReadOptions& options) {
  Geometry out;
  if (mesh_.triangles.empty()) return out;
  check_mesh(mesh_, subject);
  out.mesh = weld_seams(mesh_);
  turn_if_inside_out(out.mesh, subject, options);
  out.appearance.given = colors_given;
  if (!colors_given || weight_ <= 0) return out;

  out.appearance.color = (weighted_color_ / weight_).cast<float>();
  out.appearance.transparency = static_cast<float>(weighted_transparency_ / weight_);
  bool differ = false;
  for (const auto& c : colors_) differ = differ || c != colors_.front();
  if (differ)
    out.appearance.triangle_colors = std::move(colors_);
  else
    out.appearance.color = colors_.front();
  return out;
}

}  // namespace clench
