#include "clench/render/view/lights.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace clench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double lamp_radius = 0.06;  // tangent of the half angle subtended by the lamp
constexpr float lamp_power = 0.62f, room_power = 0.62f;  // each alone, on a white surface
constexpr double floor_power = 0.42;  // fraction of its light that the floor reflects

double fraction(double x) { return x - std::floor(x); }

// evenly spread points of the unit square
// source  Roberts (2018), The unreasonable effectiveness of quasirandom sequences
Eigen::Vector2d spread(int i) {
  return {fraction(0.5 + 0.7548776662466927 * i), fraction(0.5 + 0.5698402909980532 * i)};
}

float chance(int i) { return static_cast<float>(fraction(0.5 + i * 0.6180339887498949)); }

Eigen::Vector3d towards_lamp(const Eigen::Matrix3d& axes) {
  // horizontal directions to the viewer's right and towards the viewer, also when looking straight
  // down
  Eigen::Vector3d right = axes.col(0), back;
  right.z() = 0;
  if (right.norm() < 1e-3) right = Eigen::Vector3d::UnitX();
  right.normalize();
  back = right.cross(Eigen::Vector3d::UnitZ());
  return (-0.62 * right + 0.38 * back + 1.0 * Eigen::Vector3d::UnitZ()).normalized();
}

}  // namespace

std::vector<Light> place_lamp(const Eigen::Matrix3d& axes, int count) {
  const Eigen::Vector3d lamp = towards_lamp(axes);
  const Eigen::Vector3d side = lamp.unitOrthogonal(), other = lamp.cross(side);
  std::vector<Light> out;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d u = spread(i);
    const double radius = lamp_radius * std::sqrt(u.x()), angle = 2 * pi * u.y();
    const Eigen::Vector3d to = lamp + radius * (std::cos(angle) * side + std::sin(angle) * other);
    out.push_back({to.normalized().cast<float>(), lamp_power / static_cast<float>(count),
                   1 / static_cast<float>(count), chance(i)});
  }
  return out;
}

std::vector<Light> place_room(int count) {
  // a spiral over the sphere; most lights are above, where most of the light comes from
  const int above = 3 * count / 4;
  std::vector<Light> out;
  for (int i = 0; i < count; ++i) {
    const bool high = i < above;
    const int part = high ? above : count - above;
    const double t = ((high ? i : i - above) + 0.5) / part, up = high ? 1 - t : -t;
    const double level = std::sqrt(1 - up * up), angle = i * pi * (3 - std::sqrt(5.0));
    const double s = std::clamp(0.5 + 0.9 * up, 0.0, 1.0);
    const double bright = floor_power + s * s * (3 - 2 * s) * (1 - floor_power);
    out.push_back(
        {Eigen::Vector3d(level * std::cos(angle), level * std::sin(angle), up).cast<float>(),
         static_cast<float>(room_power * bright * 2 / part), static_cast<float>(2.0 / part),
         chance(i)});
  }
  return out;
}

float light_on_floor(const std::vector<Light>& lights) {
  float sum = 0;
  for (const Light& light : lights) sum += std::max(0.0f, light.to_light.z()) * light.radiance;
  return sum;
}

std::vector<Eigen::Vector2d> place_samples(int count) {
  // maps [0, 1] to samples of a tent filter over two pixels
  const auto tent = [](double u) {
    return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
  };
  std::vector<Eigen::Vector2d> out;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d u = spread(i);
    out.emplace_back(tent(u.x()), tent(u.y()));
    sum += out.back();
  }
  for (Eigen::Vector2d& p : out) p -= sum / count;
  return out;
}

}  // namespace clench
