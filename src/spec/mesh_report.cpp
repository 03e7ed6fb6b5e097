#include "clench/spec/mesh_report.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace clench {

static std::string counted(int count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string unit_name(double length) {
  static constexpr std::pair<double, const char*> names[] = {
      {1, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {0.0254, "inch"}, {0.3048, "foot"}};
  for (const auto& [meters, name] : names)
    // files give the factor with a few decimals, or in 32 bits
    if (std::abs(length - meters) <= 1e-6 * meters) return name;
  return fmt::format("{:.6g} m", length);
}

const char* source_name(UnitSource source) {
  static constexpr const char* names[] = {"format", "file", "option", "guess"};
  return names[static_cast<int>(source)];
}

static std::string unit_sentence(const MeshReport& report) {
  static constexpr const char* sources[] = {"by the format", "by the file", "by option",
                                            "inferred from the size"};
  std::string text = fmt::format("unit {}, {}", unit_name(report.unit),
                                 sources[static_cast<int>(report.unit_source)]);
  if (report.up != 'z') text += fmt::format("; {} axis turned to z", report.up);
  return text;
}

static std::string repaired_sentence(const MeshReport& report) {
  std::string text;
  const auto append = [&](int count, const char* one, const char* many) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
  };
  append(report.welded_vertices, "vertex welded", "vertices welded");
  append(report.dropped_triangles, "degenerate triangle dropped", "degenerate triangles dropped");
  append(report.unused_vertices, "unused vertex left out", "unused vertices left out");
  if (report.flipped) text += (text.empty() ? "" : ", ") + std::string("flipped to face outward");
  return text;
}

// numbers at the level of rounding relative to `scale` become 0
template <class Numbers>
static Numbers without_rounding(const Numbers& numbers, double scale) {
  return (numbers.array().abs() < 1e-9 * scale).select(Numbers::Zero(), numbers);
}

std::vector<std::string> describe(const MeshReport& report, const Shape& shape) {
  std::vector<std::string> out;
  out.push_back(fmt::format("{}: {} of {}", report.format,
                            counted(report.triangles_read, "triangle", "triangles"),
                            counted(report.vertices_read, "vertex", "vertices")));
  out.push_back(unit_sentence(report));
  if (auto repaired = repaired_sentence(report); !repaired.empty())
    out.push_back(std::move(repaired));

  const Eigen::Vector3d size = shape.bounds().size();
  const std::string faults = shape.faults().describe();
  out.push_back(fmt::format("{}, {:.4g} x {:.4g} x {:.4g} m, {}",
                            shape.closed() ? "watertight" : "open", size.x(), size.y(), size.z(),
                            faults));
  if (!shape.has_volume()) return out;
  const MassProperties& solid = shape.solid();
  const Eigen::Vector3d c = without_rounding(solid.centroid, size.maxCoeff());
  const Eigen::Matrix3d I = without_rounding(solid.inertia, solid.inertia.cwiseAbs().maxCoeff());
  out.push_back(fmt::format("volume {:.6g} m^3, center of mass ({:.6g}, {:.6g}, {:.6g}) m",
                            solid.volume, c.x(), c.y(), c.z()));
  out.push_back(fmt::format(
      "inertia per kg: xx {:.4g}, yy {:.4g}, zz {:.4g}, xy {:.4g}, xz {:.4g}, yz {:.4g} m^2",
      I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
  return out;
}

}  // namespace clench
