// Wrench spaces as a picture with three wrench coordinates as axes.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "clench/scene/scene.h"

namespace clench {

/// A solid in the space of three wrench coordinates, with its annotations.
struct WrenchPicture {
  ShapePtr solid;                                     ///< vertices; torques over rho, in newtons
  std::array<std::string, 3> axes = {"x", "y", "z"};  ///< names of the three coordinates
  double ball = 0;                              ///< radius of a ball around the origin; 0: none
  std::optional<Eigen::Vector3d> weakest = {};  ///< direction of the smallest reach, of any length
  std::string title = {};                       ///< first line of the caption
  double epsilon = 0;                           ///< shown in its second line [N]
};

/// The solid, transparent, with axes that extend beyond it, numbers at round steps along them [N],
/// the ball and its radius, and an arrow along the weakest direction. Labels: the axes, the weakest
/// direction, the ball, then the numbers. The caption states epsilon and the unit.
Scene make_wrench_scene(const WrenchPicture& picture);

}  // namespace clench
