#include "clench/dynamics/weld.h"

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/dynamics/tree/tree_dynamics.h"

namespace clench {

static void check_weld(const World& world, Id<Body> object, Id<Body> to) {
  const std::string name = excerpt(world.body(object).name);
  if (world.body(object).kind != BodyKind::object)
    fail("expected an object to weld, got '{}'", name);
  if (object == to) fail("'{}' cannot be welded to itself", name);
  const auto& welds = world.dynamic_settings().welds;
  if (const auto old = welds.find(object); old != welds.end())
    fail("'{}' is welded to '{}' already", name, excerpt(world.body(old->second).name));
  Id<Body> carrier = to;
  for (auto next = welds.find(carrier); next != welds.end(); next = welds.find(carrier))
    carrier = next->second;
  if (carrier == object) fail("'{}' is welded to '{}' already", excerpt(world.body(to).name), name);
}

void weld(World& world, Id<Body> object, Id<Body> to) {
  check_weld(world, object, to);
  DynamicState& state = world.edit_dynamics();
  // the rigid piece that the object was
  const System before = find_system(world);
  const Articulation& piece = before.trees[before.place(object).tree];
  TreeDynamics apart;
  apart.place(world, piece);
  Eigen::VectorXd v;
  gather_velocities(before, world, state, v);
  const Eigen::VectorXd of_piece = v.segment(piece.first, piece.size());

  DynamicSettings settings = world.dynamic_settings();
  settings.welds[object] = to;
  world.set_dynamic_settings(std::move(settings));
  const System system = find_system(world);
  if (system.place(object).tree < 0) {
    state.twists[object.index] = world.carried_twist(object, to);
    return;
  }
  const Articulation& tree = system.trees[system.place(object).tree];
  TreeDynamics together;
  together.place(world, tree);
  gather_velocities(system, world, state, v);
  auto own = v.segment(tree.first, tree.size());
  const Vector6d root = prescribed_twist(world, tree);

  // an impulse equal to the piece's momentum in excess of that as a part of the carrier
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(tree.size());
  for (size_t i = 0; i < piece.bodies.size(); ++i) {
    const Body& body = world.body(piece.bodies[i].body);
    const int part = system.place(piece.bodies[i].body).body;
    const Twist was = apart.twist(static_cast<int>(i), of_piece, Vector6d::Zero()),
                is = together.twist(part, own, root);
    const Eigen::Matrix3d R = world.pose(piece.bodies[i].body).matrix();
    const Eigen::Vector3d linear = body.mass * (was.linear - is.linear);
    const Eigen::Vector3d angular =
        R * (body.mass * body.inertia_per_mass) * R.transpose() * (was.angular - is.angular);
    together.add_linear(part, together.com(part), linear, 1, impulse);
    together.add_angular(part, angular, 1, impulse);
  }
  Eigen::VectorXd armature = Eigen::VectorXd::Zero(tree.size());
  for (const ArticulationJoint& joint : tree.joints)
    armature[joint.coordinate] +=
        joint.ratio * joint.ratio * world.robot(joint.robot).joints[joint.joint].armature;
  together.factor(armature);
  together.half_solve(impulse);
  together.other_half_solve(impulse);
  own += impulse;
  scatter_velocities(system, world, v, state);
  for (size_t i = 0; i < tree.bodies.size(); ++i)
    if (tree.bodies[i].body != tree.root)
      state.twists[tree.bodies[i].body.index] = together.twist(static_cast<int>(i), own, root);
}

void unweld(World& world, Id<Body> object) {
  DynamicSettings settings = world.dynamic_settings();
  if (settings.welds.erase(object) == 0)
    fail("'{}' is not welded", excerpt(world.body(object).name));
  world.set_dynamic_settings(std::move(settings));
}

}  // namespace clench
