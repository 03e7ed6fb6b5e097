// Corners of triangles as the graphics card takes them.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace clench {

/// One corner of triangles as the shaders read it.
struct Corner {
  Eigen::Vector3f p;  ///< scene units
  Eigen::Vector3f n;  ///< unit, to the side from which the triangle runs counter-clockwise
  std::array<uint8_t, 4> color;  ///< red green blue as on a screen, opacity
};
static_assert(sizeof(Corner) == 28);

}  // namespace clench
