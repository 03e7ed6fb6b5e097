#include "clench/dynamics/tree/articulation.h"

#include <algorithm>

namespace clench {

namespace {

class TreeBuilder {
 public:
  TreeBuilder(const World& world, Articulation& tree) : world_(world), tree_(tree) {}

  // carrier  the joint of the tree that moves the robot's base
  void add_robot(Id<Robot> id, int carrier) {
    const Robot& robot = world_.robot(id);
    tree_.robots.push_back(id);
    tree_.bodies.push_back({robot.base, carrier});
    if (robot.mounting && robot.mounting->piece)
      tree_.bodies.push_back({*robot.mounting->piece, carrier});
    std::vector<int> moved_by(robot.links.size());
    std::vector<int> coordinate_of(robot.dofs.size(), -1);
    for (size_t l = 0; l < robot.links.size(); ++l) {
      const Link& link = robot.links[l];
      int before = link.parent < 0 ? carrier : moved_by[link.parent];
      for (int j = link.first_joint; j < link.end_joint; ++j)
        before = add_joint(id, robot, j, before, coordinate_of);
      moved_by[l] = before;
      tree_.bodies.push_back({link.body, before});
    }
    for (const auto other : world_.robots()) {
      const auto& mounting = world_.robot(other).mounting;
      if (mounting && mounting->parent == id) add_robot(other, moved_by[mounting->link]);
    }
  }

 private:
  int add_joint(Id<Robot> id, const Robot& robot, int j, int before,
                std::vector<int>& coordinate_of) {
    const Joint& joint = robot.joints[j];
    const bool alone =
        robot.dofs[joint.dof].kind == DofKind::compliant || !world_.follows_dof(id, j);
    const Coordinate coordinate{.robot = id,
                                .dof = joint.dof,
                                .joint = alone ? j : -1,
                                .dof_index = robot.first_dof + static_cast<size_t>(joint.dof),
                                .joint_index = robot.first_joint + static_cast<size_t>(j)};
    int number = alone ? -1 : coordinate_of[joint.dof];
    if (number < 0) {
      number = tree_.size();
      tree_.coordinates.push_back(coordinate);
      if (!alone) coordinate_of[joint.dof] = number;
    }
    tree_.joints.push_back(
        {id, j, before, number, alone ? 1 : joint.ratio, joint.kind == JointKind::prismatic});
    return static_cast<int>(tree_.joints.size()) - 1;
  }

  const World& world_;
  Articulation& tree_;
};

void add_welded(const World& world, Id<Body> object, Id<Body> to, System& system) {
  const auto known = [&](const auto& weld) { return weld.first == object; };
  if (std::ranges::any_of(system.welds, known)) return;
  const auto& welds = world.dynamic_settings().welds;
  if (const auto carrier = welds.find(to); carrier != welds.end())
    add_welded(world, to, carrier->second, system);
  system.welds.emplace_back(object, to);
  const System::Place place = system.place(to);
  if (place.tree < 0) return;
  auto& bodies = system.trees[place.tree].bodies;
  bodies.push_back({object, bodies[place.body].joint, true});
  system.places[object.index] = {place.tree, static_cast<int>(bodies.size()) - 1};
}

}  // namespace

System find_system(const World& world) {
  System system;
  const auto add = [&](Articulation tree) {
    tree.first = system.size;
    system.size += tree.size();
    for (size_t i = 0; i < tree.bodies.size(); ++i)
      system.places[tree.bodies[i].body.index] = {static_cast<int>(system.trees.size()),
                                                  static_cast<int>(i)};
    system.trees.push_back(std::move(tree));
  };
  system.places.resize(world.model().bodies.size());
  for (const auto id : world.bodies())
    if (world.body(id).kind == BodyKind::object && !world.dynamic_settings().welds.contains(id))
      add({.floating = true,
           .root = id,
           .joints = {},
           .bodies = {{id, -1}},
           .coordinates = {},
           .robots = {}});
  for (const auto id : world.robots()) {
    if (world.robot(id).mounting) continue;
    Articulation tree;
    tree.root = world.robot(id).base;
    tree.floating = world.dynamic_settings().robot(id).floating;
    TreeBuilder(world, tree).add_robot(id, -1);
    add(std::move(tree));
  }
  for (const auto& [object, to] : world.dynamic_settings().welds)
    add_welded(world, object, to, system);
  return system;
}

static Eigen::Vector3d com(const World& world, Id<Body> id) {
  return world.pose(id) * world.body(id).com;
}

Eigen::Vector3d center(const World& world, const Articulation& tree) {
  if (!tree.is_free_body() || tree.bodies.size() == 1) return com(world, tree.root);
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const TreeBody& part : tree.bodies) {
    mass += world.body(part.body).mass;
    moment += world.body(part.body).mass * com(world, part.body);
  }
  return moment / mass;
}

Eigen::Matrix<double, 6, 6> free_motion(const World& world, const Articulation& tree) {
  const Eigen::Vector3d r = world.pose(tree.root).position - center(world, tree);
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Identity();
  // w x r
  J.topRightCorner<3, 3>() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  return J;
}

Vector6d prescribed_twist(const World& world, const Articulation& tree) {
  Vector6d out = Vector6d::Zero();
  if (tree.floating) return out;
  const Twist twist = world.twist(tree.root);
  out << twist.linear, twist.angular;
  return out;
}

void gather_velocities(const System& system, const World& world, const DynamicState& state,
                       Eigen::VectorXd& v) {
  v.resize(system.size);
  for (const Articulation& tree : system.trees) {
    int at = tree.first;
    if (tree.floating) {
      const Twist& twist = state.twists[tree.root.index];
      v.segment<3>(at) =
          twist.linear + twist.angular.cross(center(world, tree) - com(world, tree.root));
      v.segment<3>(at + 3) = twist.angular;
      at += 6;
    }
    for (const Coordinate& c : tree.coordinates)
      v[at++] =
          c.joint < 0 ? state.dof_velocities[c.dof_index] : state.joint_velocities[c.joint_index];
  }
}

void scatter_velocities(const System& system, const World& world, const Eigen::VectorXd& v,
                        DynamicState& state) {
  for (const Articulation& tree : system.trees) {
    if (tree.floating) {
      const Eigen::Vector3d linear = v.segment<3>(tree.first),
                            angular = v.segment<3>(tree.first + 3);
      state.twists[tree.root.index] = {
          linear + angular.cross(com(world, tree.root) - center(world, tree)), angular};
    }
    for (const ArticulationJoint& joint : tree.joints)
      state.joint_velocities[world.robot(joint.robot).first_joint +
                             static_cast<size_t>(joint.joint)] =
          joint.ratio * v[tree.first + joint.coordinate];
    for (size_t i = 0; i < tree.coordinates.size(); ++i)
      if (const Coordinate& c = tree.coordinates[i]; c.joint < 0)
        state.dof_velocities[c.dof_index] = v[tree.first + tree.root_size() + static_cast<int>(i)];
  }
}

}  // namespace clench
