#include "clench/scene/wrench_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "clench/base/convert.h"
#include "clench/math/round_step.h"
#include "clench/scene/palette.h"

namespace clench {

namespace {

constexpr double axis_reach = 1.15;    // beyond the solid, as a fraction of its size
constexpr double arrow_width = 0.006;  // as a fraction of the solid's size
constexpr double steps = 4;            // maximum number of labels along half an axis
constexpr double tick_length = 0.025, tick_end = 0.08;  // as fractions of the solid's size
constexpr int ball_rings = 24;

ShapePtr ball_of(double radius) {
  Mesh mesh;
  const int around = 2 * ball_rings;
  const auto at = [&](int ring, int i) { return 1 + (ring - 1) * around + i % around; };
  mesh.vertices.push_back({0, 0, 1});
  for (int ring = 1; ring < ball_rings; ++ring)
    for (int i = 0; i < around; ++i) {
      const double polar = std::numbers::pi * ring / ball_rings;
      const double turn = 2 * std::numbers::pi * i / around;
      mesh.vertices.push_back(
          {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)});
    }
  const int south = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back({0, 0, -1});
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, at(1, i), at(1, i + 1)});
    for (int ring = 1; ring + 1 < ball_rings; ++ring) {
      mesh.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      mesh.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
    mesh.triangles.push_back({at(ball_rings - 1, i + 1), at(ball_rings - 1, i), south});
  }
  for (Eigen::Vector3d& p : mesh.vertices) p *= radius;
  return Shape::make(std::move(mesh), "ball");
}

// of a picture
struct AxisRange {
  double low, high;
};

// an axis extends beyond the solid, and beyond the origin if the solid does not
AxisRange reach_of(const Bounds& bounds, int k, double size) {
  const double more = (axis_reach - 1) * size;
  return {std::min(0.0, bounds.low[k]) - more, std::max(0.0, bounds.high[k]) + more};
}

// a pin across the axis at each nonzero multiple of the step, with its number
void add_ticks(int k, const AxisRange& range, double step, double size, Scene& out) {
  const Eigen::Vector3d along = Eigen::Vector3d::Unit(k),
                        across = Eigen::Vector3d::Unit((k + 2) % 3);
  for (int i = floor_int(std::ceil(range.low / step));
       static_cast<double>(i) * step < range.high - tick_end * size; ++i) {
    if (i == 0) continue;
    const double value = static_cast<double>(i) * step;
    out.cones.push_back({.apex = value * along,
                         .axis = -across,
                         .height = tick_length * size,
                         .color = palette::axes[k]});
    out.labels.push_back({value * along - 2 * tick_length * size * across,
                          fmt::format("{:.4g}", value), palette::axes[k]});
  }
}

void add_caption(const WrenchPicture& picture, Scene& out) {
  if (!picture.title.empty()) out.caption.push_back(picture.title);
  out.caption.push_back(
      fmt::format("epsilon {:.4g} N; numbers in N, torques over rho", picture.epsilon));
}

}  // namespace

Scene make_wrench_scene(const WrenchPicture& picture) {
  Scene out;
  const Bounds& bounds = picture.solid->bounds();
  const double size = std::max(bounds.low.cwiseAbs().maxCoeff(), bounds.high.cwiseAbs().maxCoeff());
  out.meshes.push_back(
      {.shape = picture.solid, .X_WM = {}, .color = palette::wrenches, .opacity = 0.32f});
  if (picture.ball > 0)
    out.meshes.push_back({.shape = ball_of(picture.ball), .X_WM = {}, .color = palette::ball});

  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
    const Eigen::Vector3f& color = palette::axes[k];
    const auto [low, high] = reach_of(bounds, k, size);
    out.arrows.push_back(
        {.tail = low * axis, .tip = high * axis, .radius = arrow_width * size, .color = color});
    out.labels.push_back({(high + 0.05 * size) * axis, picture.axes[k], color});
  }
  if (picture.weakest && picture.weakest->norm() > 0) {
    const Eigen::Vector3d direction = picture.weakest->normalized();
    const Eigen::Vector3d tip = 0.8 * size * direction;
    out.arrows.push_back({.tail = Eigen::Vector3d::Zero(),
                          .tip = tip,
                          .radius = 1.5 * arrow_width * size,
                          .color = palette::weakest});
    out.labels.push_back({tip + 0.05 * size * direction, "weakest", palette::weakest});
  }
  if (picture.ball > 0)
    out.labels.push_back({-1.3 * picture.ball * Eigen::Vector3d::UnitZ(),
                          fmt::format("radius {:.3g}", picture.ball), palette::ball_label});
  const double step = size > 0 ? round_step(size / steps) : 1;
  for (int k = 0; k < 3; ++k) add_ticks(k, reach_of(bounds, k, size), step, size, out);
  add_caption(picture, out);
  return out;
}

}  // namespace clench
