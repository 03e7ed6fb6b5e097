#include "clench/dynamics/ode/ode_scene.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/dynamics/ode/ode_library.h"

namespace clench {

// There is no body between successive joints; ODE requires one. Its mass is this fraction of the
// adjacent ones: nearly zero.
static constexpr double ghost = 1e-6;
// Compliance of joints, as a fraction of an impulse's effect on a body.
static constexpr double soft_joint = 1e-9;

static void add_mass(const Body& body, const Pose& X_WB, OdeNode& node) {
  const Eigen::Vector3d com = X_WB * body.com;
  const Eigen::Matrix3d R = X_WB.matrix();
  const double sum = node.mass + body.mass;
  if (!(sum > 0)) return;
  const Eigen::Vector3d apart = com - node.com;
  node.inertia +=
      R * (body.mass * body.inertia_per_mass) * R.transpose() +
      node.mass * body.mass / sum *
          (apart.squaredNorm() * Eigen::Matrix3d::Identity() - apart * apart.transpose());
  node.com += body.mass / sum * apart;
  node.mass = sum;
}

OdeScene::OdeScene(const World& world, const OdeProblem& problem, double h, double softness)
    : world_(world), problem_(problem), h_(h), softness_(softness) {
  start_ode();
  ode_.reset(dWorldCreate());
  trees_.resize(problem.system.trees.size());
  obstacle_nodes_.resize(world.model().bodies.size());
  double heaviest = 0;
  for (size_t t = 0; t < trees_.size(); ++t) {
    add_tree(problem.system.trees[t], static_cast<int>(t));
    for (const OdeNode& node : trees_[t].nodes)
      if (node.free) heaviest = std::max(heaviest, node.mass);
  }
  if (heaviest > 0) dWorldSetCFM(ode_.get(), soft_joint * h / heaviest);
  for (const auto id : world.bodies())
    if (const Twist twist = world.twist(id);
        problem.system.place(id).tree < 0 && !twist.is_zero()) {
      OdeNode& node = obstacle_nodes_[id.index];
      node.com = world.pose(id) * world.body(id).com;
      node.v = twist.linear;
      node.w = twist.angular;
      make_body(node);
    }
  for (size_t t = 0; t < trees_.size(); ++t) {
    add_forces(problem.system.trees[t], static_cast<int>(t));
    base_impulse(problem.system.trees[t], static_cast<int>(t));
  }
}

void OdeScene::make_body(OdeNode& node) {
  node.body = dBodyCreate(ode_.get());
  dBodySetGyroscopicMode(node.body, 0);
  dBodySetPosition(node.body, node.com.x(), node.com.y(), node.com.z());
  if (!node.free) return dBodySetKinematic(node.body);
  const Eigen::Matrix3d& I = node.inertia;
  dMass mass;
  dMassSetParameters(&mass, node.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2),
                     I(1, 2));
  dBodySetMass(node.body, &mass);
}

void OdeScene::add_tree(const Articulation& tree, int number) {
  OdeTree& out = trees_[number];
  out.nodes.resize(tree.joints.size() + 1);
  for (const TreeBody& part : tree.bodies)
    add_mass(world_.body(part.body), world_.pose(part.body), out.nodes[part.joint + 1]);
  // successive joints: the body between them has the pose of the next body
  for (size_t i = tree.joints.size(); i-- > 0;) {
    OdeNode &node = out.nodes[i + 1], &before = out.nodes[tree.joints[i].parent + 1];
    if (tree.joints[i].parent < 0 || before.mass > 0) continue;
    before.com = node.com;
    before.mass = ghost * node.mass;
    before.inertia = ghost * node.inertia;
  }
  out.nodes[0].free = tree.floating;
  const bool prescribed = !tree.floating && !world_.twist(tree.root).is_zero();
  if (tree.floating || prescribed) make_body(out.nodes[0]);
  out.lead.assign(tree.size(), -1);
  RobotFrames frames;
  Id<Robot> framed;
  for (size_t i = 0; i < tree.joints.size(); ++i) {
    const ArticulationJoint& joint = tree.joints[i];
    const Robot& robot = world_.robot(joint.robot);
    if (joint.robot != framed) frames = world_.frames(framed = joint.robot);
    out.nodes[i + 1].free = true;
    make_body(out.nodes[i + 1]);
    add_joint(joint, frames.joints[joint.joint].position,
              frames.axis(robot, joint.joint).normalized(), out);
    if (int& lead = out.lead[joint.coordinate]; lead < 0 && joint.ratio != 0)
      lead = static_cast<int>(i);
  }
  find_motion(tree, number);
}

void OdeScene::add_joint(const ArticulationJoint& joint, const Eigen::Vector3d& origin,
                         const Eigen::Vector3d& axis, OdeTree& out) {
  const int child = static_cast<int>(out.joints.size()) + 1, parent = joint.parent + 1;
  OdeJoint made{
      .child = child, .parent = parent, .origin = origin, .axis = axis, .slides = joint.slides};
  made.joint = joint.slides ? dJointCreateSlider(ode_.get(), nullptr)
                            : dJointCreateHinge(ode_.get(), nullptr);
  dJointAttach(made.joint, out.nodes[child].body, out.nodes[parent].body);
  if (joint.slides) {
    dJointSetSliderAxis(made.joint, axis.x(), axis.y(), axis.z());
  } else {
    dJointSetHingeAnchor(made.joint, origin.x(), origin.y(), origin.z());
    dJointSetHingeAxis(made.joint, axis.x(), axis.y(), axis.z());
  }
  out.joints.push_back(made);
}

// velocities, and the accelerations that they cause, outwards from the root
void OdeScene::find_motion(const Articulation& tree, int number) {
  OdeTree& out = trees_[number];
  OdeNode& root = out.nodes[0];
  // the group's center of mass is elsewhere if something is fixed to the root
  const Eigen::Vector3d arm = root.com - center(world_, tree);
  Twist twist = world_.twist(tree.root);
  if (tree.floating)
    twist = {problem_.v.segment<3>(tree.first), problem_.v.segment<3>(tree.first + 3)};
  if (root.body) {
    root.w = twist.angular;
    root.v = twist.linear + root.w.cross(arm);
    const Vector6d& coasting = problem_.root_accelerations[number];
    root.turning = coasting.tail<3>();
    root.acceleration =
        coasting.head<3>() + root.turning.cross(arm) + root.w.cross(root.w.cross(arm));
  }
  for (size_t i = 0; i < out.joints.size(); ++i) {
    const OdeJoint& joint = out.joints[i];
    const OdeNode& before = out.nodes[joint.parent];
    OdeNode& node = out.nodes[joint.child];
    const double speed = tree.joints[i].ratio * problem_.v[tree.first + tree.joints[i].coordinate];
    const Eigen::Vector3d along = speed * joint.axis;
    const auto carry = [&](const Eigen::Vector3d& r, const OdeNode& by, Eigen::Vector3d& v,
                           Eigen::Vector3d& a) {
      v += by.w.cross(r);
      a += by.turning.cross(r) + by.w.cross(by.w.cross(r));
    };
    node.v = before.v;
    node.acceleration = before.acceleration;
    node.w = before.w;
    node.turning = before.turning;
    if (joint.slides) {
      carry(node.com - before.com, before, node.v, node.acceleration);
      node.v += along;
      node.acceleration += 2 * before.w.cross(along);
      continue;
    }
    carry(joint.origin - before.com, before, node.v, node.acceleration);
    node.w += along;
    node.turning += before.w.cross(along);
    carry(node.com - joint.origin, node, node.v, node.acceleration);
  }
}

// bodies attached to a base whose velocity jumps keep their velocities
void OdeScene::base_impulse(const Articulation& tree, int number) {
  if (tree.floating) return;
  OdeTree& out = trees_[number];
  const Twist twist = world_.twist(tree.root), last = world_.dynamics()->solved[tree.root.index];
  const Eigen::Vector3d dv = twist.linear - last.linear, dw = twist.angular - last.angular;
  const Eigen::Vector3d about = world_.pose(tree.root) * world_.body(tree.root).com;
  for (size_t i = 1; i < out.nodes.size(); ++i) {
    out.nodes[i].w -= dw;
    out.nodes[i].v -= dv + dw.cross(out.nodes[i].com - about);
  }
}

void OdeScene::add_forces(const Articulation& tree, int number) {
  OdeTree& out = trees_[number];
  const DynamicState& state = *world_.dynamics();
  for (size_t i = 0; i < out.nodes.size(); ++i) {
    OdeNode& node = out.nodes[i];
    if (!node.free) continue;
    // the rotation of a free body conserves its momentum: see Mover
    if (!tree.is_free_body()) {
      node.force = -node.mass * node.acceleration;
      const Eigen::Vector3d spin = node.inertia * node.w;
      node.torque = -node.inertia * node.turning - node.w.cross(spin);
    }
    node.force += node.mass * world_.gravity();
  }
  for (const TreeBody& part : tree.bodies) {
    OdeNode& node = out.nodes[part.joint + 1];
    const Load& load = state.loads[part.body.index];
    const Body& body = world_.body(part.body);
    Eigen::Vector3d force = load.force;
    if (body.gravity_compensation != 0)
      force -= body.gravity_compensation * body.mass * world_.gravity();
    node.force += force;
    node.torque += load.torque + (world_.pose(part.body) * body.com - node.com).cross(force);
  }
  damp_root(tree, number);
  // springs and the prescribed efforts of motors; armature and dampers as compliant motors
  const JointForces& forces = problem_.forces[number];
  if (tree.floating && !tree.is_free_body()) {
    OdeNode& root = out.nodes[0];
    const Eigen::Vector3d f = forces.efforts.head<3>();
    root.force += f;
    root.torque += forces.efforts.segment<3>(3) + (center(world_, tree) - root.com).cross(f);
  }
  for (size_t i = 0; i < tree.coordinates.size(); ++i) {
    const int c = tree.root_size() + static_cast<int>(i), lead = out.lead[c];
    if (lead < 0) continue;
    const double ratio = tree.joints[lead].ratio;
    push(number, lead,
         (forces.efforts[c] + feedforward_effort(world_, tree.coordinates[i], state)) / ratio);
    if (const double added = forces.added[c]; added > 0) {
      const double kept = (added - forces.velocity_part[c]) * problem_.v[tree.first + c] / added;
      add_motor(out, out.joints[lead], ratio * kept, h_ * ratio * ratio / added, dInfinity);
    }
  }
}

// viscous resistance to free motion at the end of the step
void OdeScene::damp_root(const Articulation& tree, int number) {
  const Eigen::MatrixXd& damped = problem_.forces[number].root_velocity_part;
  if (damped.size() == 0) return;
  OdeNode& root = trees_[number].nodes[0];
  // from the center of the coordinates to that of the node
  const Eigen::Vector3d arm = root.com - center(world_, tree);
  Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Identity() * root.mass, J = M;
  M.bottomRightCorner<3, 3>() = root.inertia;
  J.setIdentity();
  J.topRightCorner<3, 3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  const Eigen::Matrix<double, 6, 6> inertia = J.transpose() * M * J;
  const Vector6d v = problem_.v.segment<6>(tree.first);
  const Vector6d change = -(inertia + damped).ldlt().solve(damped * v);
  const Vector6d force = J.transpose().lu().solve(inertia * change / h_);
  root.force += force.head<3>();
  root.torque += force.tail<3>();
}

void OdeScene::push(int tree, int number, double effort) {
  OdeTree& t = trees_[tree];
  const OdeJoint& joint = t.joints[number];
  OdeNode &child = t.nodes[joint.child], &parent = t.nodes[joint.parent];
  const Eigen::Vector3d e = effort * joint.axis;
  if (joint.slides) {
    // along one line through the child's center of mass
    child.force += e;
    parent.force -= e;
    parent.torque -= (child.com - parent.com).cross(e);
  } else {
    child.torque += e;
    parent.torque -= e;
  }
}

void OdeScene::step() {
  const auto reset = [](const OdeNode& node) {
    if (!node.body) return;
    const dQuaternion straight = {1, 0, 0, 0};
    dBodySetPosition(node.body, node.com.x(), node.com.y(), node.com.z());
    dBodySetQuaternion(node.body, straight);
    dBodySetLinearVel(node.body, node.v.x(), node.v.y(), node.v.z());
    dBodySetAngularVel(node.body, node.w.x(), node.w.y(), node.w.z());
    dBodySetForce(node.body, node.force.x(), node.force.y(), node.force.z());
    dBodySetTorque(node.body, node.torque.x(), node.torque.y(), node.torque.z());
  };
  for (const OdeTree& tree : trees_)
    for (const OdeNode& node : tree.nodes) reset(node);
  for (const OdeNode& node : obstacle_nodes_) reset(node);
  check_stop();
  constexpr int iterations = 2000;
  dWorldSetQuickStepNumIterations(ode_.get(), iterations);
  if ((iterates_ ? dWorldQuickStep(ode_.get(), h_) : dWorldStep(ode_.get(), h_)) == 0)
    fail(ErrorKind::limit, "dynamics: ODE is out of memory for a step");
}

Twist OdeScene::root_twist(int tree) const {
  const OdeNode& node = trees_[tree].nodes[0];
  const Eigen::Vector3d w = turning_of(node);
  return {velocity_of(node) + w.cross(center(world_, problem_.system.trees[tree]) - node.com), w};
}

}  // namespace clench
