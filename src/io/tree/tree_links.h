// What the readers of URDF and MJCF share about links: mass properties, and which geometry
// collides.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/io/tree/tree_geometry.h"
#include "clench/io/tree/tree_model.h"
#include "clench/spec/inertia.h"

namespace clench {

/// Pieces of one link as its file gives them.
struct LinkPieces {
  std::vector<GeometryPiece> collision, visual;
  Place place;                ///< hand.urdf:31
  bool has_inertial = false;  ///< are mass, center and inertia in the link's body?
};

/// Gives each link its shape and looks. Bodies collide with the collision pieces alone; where no
/// link of the robot has any, all collide with the visual ones. Links without mass in the file
/// weigh what water of their volume does, frames without geometry and open surfaces a gram. Tells
/// what it guesses.
/// `pieces`  one per link
/// `contacts_known`  does the file say what collides, and with which friction? then nothing collides
///                   that has only visual pieces
void dress_links(TreeModel& tree, const std::vector<LinkPieces>& pieces, TreeGeometry& geometry,
                 const std::string& file, const FileCache& cache, bool contacts_known = false);

/// Mass, center and inertia of a link from the inertia about its center of mass [kg m^2].
Inertial set_inertial(BodySpec& body, double mass, const Pose& X_LC,
                      const Eigen::Matrix3d& inertia_C);

/// Tells of links whose inertias are wrong in the same way, at once.
class InertialFaults {
 public:
  void add(Inertial fault, const Place& place, const std::string& link);
  void tell(const FileCache& cache) const;

 private:
  std::array<Place, 3> places_;  // of the first; no_body, not_definite, not_given
  std::array<std::vector<std::string>, 3> links_;
};

/// Largest numbers of a robot's parts, far above any robot.
inline constexpr int max_links = 1000, max_joints = 1000, max_pieces = 20000;

}  // namespace clench
