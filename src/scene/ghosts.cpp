#include "clench/scene/ghosts.h"

#include <fmt/format.h>

#include <algorithm>

#include "clench/base/error.h"
#include "clench/scene/palette.h"

namespace clench {

void add_ghost(const World& world, Id<Robot> robot, const Eigen::Vector3f& color, Scene& scene) {
  for (const Id<Body> id : world.bodies_of(robot)) {
    const Body& body = world.body(id);
    const ShapePtr& shape = body.appearance.visual ? body.appearance.visual : body.shape;
    if (!shape) continue;
    scene.meshes.push_back({.shape = shape,
                            .X_WM = world.pose(id),
                            .color = color,
                            .opacity = palette::ghost_opacity,
                            .framed = false});
  }
}

static constexpr double meters_per_newton = 0.005, meters_per_newton_meter = 0.05;
static constexpr double longest_wrench = 0.2, shortest_wrench = 0.001, wrench_rod = 0.0025,
                        beyond_wrench = 1.15;  // [m]

static void add_arrow(const Eigen::Vector3d& from, const Eigen::Vector3d& value, double scale,
                      const Eigen::Vector3f& color, const char* unit, Scene& scene) {
  const double size = value.norm(), length = std::min(longest_wrench, scale * size);
  if (length < shortest_wrench) return;
  const Eigen::Vector3d along = value / size * length;
  scene.arrows.push_back({.tail = from,
                          .tip = from + along,
                          .radius = std::min(wrench_rod, 0.1 * length),
                          .color = color,
                          .shown = {.kind = Shown::Kind::force}});
  scene.labels.push_back({.p_W = from + beyond_wrench * along,
                          .text = fmt::format("{:.3g} {}", size, unit),
                          .color = color});
}

void add_wrench(const PlacedWrench& wrench, Scene& scene) {
  if (!wrench.p_W.allFinite() || !wrench.f_W.allFinite() || !wrench.t_W.allFinite())
    fail("a wrench in a picture: expected finite numbers");
  add_arrow(wrench.p_W, wrench.f_W, meters_per_newton, palette::net_force, "N", scene);
  add_arrow(wrench.p_W, wrench.t_W, meters_per_newton_meter, palette::net_torque, "N m", scene);
}

}  // namespace clench
