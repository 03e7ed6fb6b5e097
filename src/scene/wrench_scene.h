// Wrench spaces as a picture: three of their coordinates as the axes of a space.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace clench {

/// A solid in the space of three wrench coordinates, and what is worth knowing about it.
struct WrenchPicture {
  ShapePtr solid;                                     ///< torques over rho, in newtons
  std::array<std::string, 3> axes = {"x", "y", "z"};  ///< their names
  double ball = 0;                              ///< radius of a ball about the origin; 0: none
  std::optional<Eigen::Vector3d> weakest = {};  ///< direction that is reached least; any length
};

/// The solid, seen through, with axes that reach beyond it, the ball, and an arrow along the weakest
/// direction.
Scene make_wrench_scene(const WrenchPicture& picture);

}  // namespace clench
