// A studio as many small lamps: together they are one broad lamp and a bright room.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

struct Light {
  Eigen::Vector3f to_light = Eigen::Vector3f::UnitZ();  ///< unit
  float radiance = 0;  ///< linear; light reflected by an unoccluded white surface that faces it
  float share = 0;     ///< fraction of the light that a surface can receive, by direction only
  /// 0..1, spread evenly: a body of opacity a blocks the fraction a of all lights
  float chance = 0;
};

/// Points of a round lamp to the viewer's upper left, evenly spread. `axes`: right, up, back of the
/// view.
std::vector<Light> place_lamp(const Eigen::Matrix3d& axes, int count);

/// Directions all around: a bright ceiling, and a floor that reflects a fraction of it.
std::vector<Light> place_room(int count);

/// Light of all lights reflected by an unoccluded white surface facing up.
float light_on_floor(const std::vector<Light>& lights);

/// Position of each sample, in pixels relative to (0, 0), which is their mean; spread as a tent
/// over two pixels.
std::vector<Eigen::Vector2d> place_samples(int count);

}  // namespace clench
