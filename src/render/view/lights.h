// A studio as many small lamps: together they are one broad lamp and a bright room.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

struct Light {
  Eigen::Vector3f to_light = Eigen::Vector3f::UnitZ();  ///< unit
  float radiance = 0;  ///< linear; what a white surface facing it returns, nothing in between
  float share = 0;     ///< of it in all the light that a surface could get, by direction alone
  /// 0..1, spread evenly: a body of opacity a throws the shadow of a part a of all lights
  float chance = 0;
};

/// Points of a round lamp to the viewer's upper left, evenly spread. `axes`: right, up, back of the
/// view.
std::vector<Light> place_lamp(const Eigen::Matrix3d& axes, int count);

/// Directions all around: a bright ceiling, and a floor that returns part of it.
std::vector<Light> place_room(int count);

/// What lights together return from a white surface facing up, nothing in between.
float light_on_floor(const std::vector<Light>& lights);

/// Where each sample looks, in pixels about (0, 0), which is their mean; spread as a tent over two
/// pixels.
std::vector<Eigen::Vector2d> place_samples(int count);

}  // namespace clench
