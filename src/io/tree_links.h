// What the readers of URDF and MJCF share about links: mass properties, and which geometry collides.
#pragma once
#include "io/library.h"
#include "io/tree_geometry.h"
#include "io/tree_model.h"

namespace clench {

/// Pieces of one link as its file gives them.
struct LinkPieces {
  std::vector<GeometryPiece> collision, visual;
  bool has_inertial = false;  ///< are mass, centre and inertia in the link's body?
};

/// Gives each link its shape and looks. Bodies collide with the collision pieces alone; where no
/// link of the robot has any, all collide with the visual ones. Links without mass in the file weigh
/// what water of their volume does, frames without geometry a gram. Tells what it guesses.
/// `pieces`  one a link
void dress_links(TreeModel& tree, const std::vector<LinkPieces>& pieces, TreeGeometry& geometry,
                 const std::string& file, const Library& library);

/// Mass and inertia of a link from those about its centre of mass; a frame's axes, kg m^2.
/// returns  what is wrong with them, or nothing; then the body is set
std::string set_inertial(BodySpec& body, double mass, const Pose& X_LC,
                         const Eigen::Matrix3d& inertia_C);

/// Largest numbers of a robot's parts, far above any robot.
inline constexpr int most_links = 1000, most_joints = 1000, most_pieces = 20000;

}  // namespace clench
