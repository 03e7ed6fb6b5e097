// From contact forces to the wrench on the object.
#pragma once
#include <span>
#include <vector>

#include "clench/contact/cone.h"

namespace clench {

/// What a contact can press with, in its frame C: normal force; with friction, then force along x
/// and y [N]; of a soft contact, then the torque about the normal [N m].
///
/// returns  1, 3 or 4
int force_count(const PointContact& contact);

/// Forces of contacts in a row, as above, to the wrench (force [N]; torque [N m]) that they are
/// together.
struct GraspMap {
  Eigen::MatrixXd matrix;   ///< 6 x forces
  std::vector<int> starts;  ///< of each contact's forces, and at the end how many there are

  int contacts() const { return static_cast<int>(starts.size()) - 1; }
  int forces() const { return starts.back(); }
};

/// Object frame O, torques about p_OM, unscaled. Contact frames are those of contact_frame().
/// source  Murray, Li & Sastry (1994), ch. 5
GraspMap grasp_map(std::span<const PointContact> contacts, const Eigen::Vector3d& p_OM);

/// Forces along x and y of contact_frame(n_W), as contacts of a world have it, to forces along x
/// and y of contact_frame(n_O), as the grasp map has them; all else stays.
///
/// returns  forces x forces, orthogonal
Eigen::MatrixXd frame_turns(const GraspMap& map, std::span<const PointContact> contacts,
                            const Eigen::Matrix3d& R_WO);

}  // namespace clench
