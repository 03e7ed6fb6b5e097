#include "clench/dynamics/step/prescribed.h"

namespace clench {

Eigen::Vector3d prescribed_velocity(const World& world, const System& system,
                                    const std::vector<TreeDynamics>& trees, Id<Body> id,
                                    const Eigen::Vector3d& p_W) {
  const System::Place place = system.place(id);
  if (place.tree < 0) {
    const Twist twist = world.twist(id);
    if (twist.is_zero()) return Eigen::Vector3d::Zero();
    return twist.linear + twist.angular.cross(p_W - world.pose(id) * world.body(id).com);
  }
  const Articulation& tree = system.trees[place.tree];
  if (tree.floating) return Eigen::Vector3d::Zero();
  const Vector6d twist = prescribed_twist(world, tree);
  const Eigen::Vector3d angular = twist.tail<3>();
  return twist.head<3>() + angular.cross(p_W - trees[place.tree].about());
}

Eigen::Vector3d prescribed_angular_velocity(const World& world, const System& system, Id<Body> id) {
  const System::Place place = system.place(id);
  if (place.tree < 0) return world.twist(id).angular;
  const Articulation& tree = system.trees[place.tree];
  if (tree.floating) return Eigen::Vector3d::Zero();
  return prescribed_twist(world, tree).tail<3>();
}

Eigen::Vector3d belt_velocity(const World& world, Id<Body> id) {
  const auto& belts = world.dynamic_settings().surface_velocities;
  const auto belt = belts.find(id);
  return belt != belts.end() ? world.pose(id).rotation * belt->second : Eigen::Vector3d::Zero();
}

}  // namespace clench
