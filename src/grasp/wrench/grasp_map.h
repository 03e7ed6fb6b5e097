// Grasp map: from contact forces to the wrench on the object.
#pragma once
#include <span>
#include <vector>

#include "clench/contact/cone.h"

namespace clench {

/// Number of force components that a contact transmits, in its frame C: normal force; with
/// friction, also force along x and y [N]; for a soft contact, also the torque about the normal [N
/// m].
///
/// returns  1, 3 or 4
int force_count(const PointContact& contact);

/// Maps the stacked forces of contacts, as above, to their resultant wrench (force [N]; torque [N
/// m]).
struct GraspMap {
  Eigen::MatrixXd matrix;  ///< 6 x forces
  /// index of each contact's first force, and at the end the number of forces
  std::vector<int> starts;

  int contacts() const { return static_cast<int>(starts.size()) - 1; }
  int forces() const { return starts.back(); }
};

/// Object frame O, torques about p_OM, unscaled. Contact frames are those of contact_frame().
/// source  Murray, Li & Sastry (1994), ch. 5
GraspMap grasp_map(std::span<const PointContact> contacts, const Eigen::Vector3d& p_OM);

/// Rotates forces along x and y of contact_frame(n_W), as in contacts of a world, to forces along x
/// and y of contact_frame(n_O), as in the grasp map; all others are unchanged.
///
/// returns  forces x forces, orthogonal
Eigen::MatrixXd frame_turns(const GraspMap& map, std::span<const PointContact> contacts,
                            const Eigen::Matrix3d& R_WO);

}  // namespace clench
