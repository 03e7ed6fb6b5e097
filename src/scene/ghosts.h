// Items that scripts add to the scene of a world.
#pragma once
#include "clench/model/world.h"
#include "clench/scene/drawn.h"

namespace clench {

/// Adds the links of a robot of any world, transparent, in one color. They can neither be picked nor
/// do they influence a computed view.
void add_ghost(const World& world, Id<Robot> robot, const Eigen::Vector3f& color, Scene& scene);

/// A force and a torque on a body; world frame.
struct PlacedWrench {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d f_W = Eigen::Vector3d::Zero();  ///< [N]
  Eigen::Vector3d t_W = Eigen::Vector3d::Zero();  ///< [N m]
};

/// Adds arrows that begin at the point, of 5 mm/N and 50 mm/(N m), at most 200 mm long, with labels.
/// Arrows shorter than 1 mm are left out.
/// throws  Error for numbers that are not finite
void add_wrench(const PlacedWrench& wrench, Scene& scene);

}  // namespace clench
