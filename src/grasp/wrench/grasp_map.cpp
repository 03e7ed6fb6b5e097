#include "clench/grasp/wrench/grasp_map.h"

#include <Eigen/Geometry>

namespace clench {

int force_count(const PointContact& contact) {
  return contact.mu <= 0 ? 1 : contact.torsion_radius > 0 ? 4 : 3;
}

GraspMap grasp_map(std::span<const PointContact> contacts, const Eigen::Vector3d& p_OM) {
  GraspMap map;
  map.starts.push_back(0);
  for (const PointContact& contact : contacts)
    map.starts.push_back(map.starts.back() + force_count(contact));
  map.matrix = Eigen::MatrixXd::Zero(6, map.forces());
  for (int i = 0; i < map.contacts(); ++i) {
    const PointContact& contact = contacts[i];
    const Eigen::Matrix3d frame = contact_frame(contact.n_O);
    const Eigen::Vector3d arm = contact.p_O - p_OM;
    const int count = force_count(contact);
    for (int k = 0; k < std::min(count, 3); ++k) {
      const Eigen::Vector3d f = frame.col((k + 2) % 3);  // z, x, y
      map.matrix.col(map.starts[i] + k) << f, arm.cross(f);
    }
    if (count == 4) map.matrix.col(map.starts[i] + 3).tail<3>() = contact.n_O;
  }
  return map;
}

Eigen::MatrixXd frame_turns(const GraspMap& map, std::span<const PointContact> contacts,
                            const Eigen::Matrix3d& R_WO) {
  Eigen::MatrixXd turns = Eigen::MatrixXd::Identity(map.forces(), map.forces());
  for (int i = 0; i < map.contacts(); ++i) {
    if (map.starts[i + 1] - map.starts[i] < 3) continue;
    const Eigen::Matrix3d in_world = contact_frame(R_WO * contacts[i].n_O);
    const Eigen::Matrix3d in_object = R_WO * contact_frame(contacts[i].n_O);
    turns.block<2, 2>(map.starts[i] + 1, map.starts[i] + 1) =
        in_object.leftCols<2>().transpose() * in_world.leftCols<2>();
  }
  return turns;
}

}  // namespace clench
