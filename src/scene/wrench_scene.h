// Wrench spaces as a picture: three of their coordinates as the axes of a space.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "clench/scene/scene.h"

namespace clench {

/// A solid in the space of three wrench coordinates, and what is worth knowing about it.
struct WrenchPicture {
  ShapePtr solid;                                     ///< torques over rho, in newtons
  std::array<std::string, 3> axes = {"x", "y", "z"};  ///< their names
  double ball = 0;                              ///< radius of a ball about the origin; 0: none
  std::optional<Eigen::Vector3d> weakest = {};  ///< direction that is reached least; any length
  std::string title = {};                       ///< first line of the caption
  double epsilon = 0;                           ///< shown in its second line [N]
};

/// The solid, seen through, with axes that reach beyond it, numbers at round steps along them [N],
/// the ball and its radius, and an arrow along the weakest direction. Labels: the axes, the weakest
/// direction, the ball, then the numbers. The caption states epsilon and the unit.
Scene make_wrench_scene(const WrenchPicture& picture);

}  // namespace clench
