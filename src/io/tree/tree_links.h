// Functions for links shared by the readers of URDF and MJCF: mass properties, and the choice of
// colliding geometry.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/io/tree/tree_geometry.h"
#include "clench/io/tree/tree_model.h"
#include "clench/spec/inertia.h"

namespace clench {

/// Pieces of one link as given by its file.
struct LinkPieces {
  std::vector<GeometryPiece> collision, visual;
  Place place;                ///< hand.urdf:31
  bool has_inertial = false;  ///< true if mass, center and inertia are set in the link's body
};

/// Sets shape and appearance of each link. Bodies collide only with the collision pieces; if no
/// link of the robot has any, all collide with the visual ones. Links without mass in the file
/// receive the mass of their volume of water, frames without geometry and links with open surfaces
/// one gram. Assumptions are reported.
/// `pieces`  one per link
/// `contacts_known`  true if the file specifies contacts and their friction; links that have only
///                   visual pieces then collide with nothing
void dress_links(TreeModel& tree, const std::vector<LinkPieces>& pieces, TreeGeometry& geometry,
                 const std::string& file, const FileCache& cache, bool contacts_known = false);

/// Mass, center and inertia of a link from the inertia about its center of mass [kg m^2].
Inertial set_inertial(BodySpec& body, double mass, const Pose& X_LC,
                      const Eigen::Matrix3d& inertia_C);

/// Reports links with the same kind of invalid inertia in one message.
class InertialFaults {
 public:
  void add(Inertial fault, const Place& place, const std::string& link);
  void tell(const FileCache& cache) const;

 private:
  std::array<Place, 3> places_;  // of the first link; no_body, not_definite, not_given
  std::array<std::vector<std::string>, 3> links_;
};

/// Limits on parts of a robot, far above the numbers in any robot.
inline constexpr int max_links = 1000, max_joints = 1000, max_pieces = 20000;

}  // namespace clench
