#include "scene/wrench_scene.h"

#include <cmath>
#include <numbers>

#include "scene/palette.h"

namespace clench {

namespace {

constexpr double axis_reach = 1.15;    // beyond the solid, part of its size
constexpr double arrow_width = 0.006;  // part of the solid's size
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
    const double low = std::min(0.0, bounds.low[k]) - (axis_reach - 1) * size;
    const double high = std::max(0.0, bounds.high[k]) + (axis_reach - 1) * size;
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
  return out;
}

}  // namespace clench
