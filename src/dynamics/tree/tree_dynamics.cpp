#include "clench/dynamics/tree/tree_dynamics.h"

#include <cmath>

#include "clench/math/decompositions.h"

namespace clench {

SpatialInertia SpatialInertia::of(const Body& body, const Pose& X_WB,
                                  const Eigen::Vector3d& about) {
  const Eigen::Matrix3d R = X_WB.matrix();
  const Eigen::Vector3d c = R * body.com + X_WB.position - about;
  const Eigen::Matrix3d turning = R * (body.mass * body.inertia_per_mass) * R.transpose();
  return {
      body.mass, body.mass * c,
      turning + body.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose())};
}

Vector6d SpatialInertia::operator*(const Vector6d& motion) const {
  const Eigen::Vector3d v = motion.head<3>(), w = motion.tail<3>();
  Vector6d out;
  out << mass * v + w.cross(moment), turning * w + moment.cross(v);
  return out;
}

static Vector6d cross_motion(const Vector6d& v, const Vector6d& m) {
  const Eigen::Vector3d w = v.tail<3>(), lin = v.head<3>(), mw = m.tail<3>(), ml = m.head<3>();
  Vector6d out;
  out << w.cross(ml) + lin.cross(mw), w.cross(mw);
  return out;
}

static Vector6d cross_force(const Vector6d& v, const Vector6d& f) {
  const Eigen::Vector3d w = v.tail<3>(), lin = v.head<3>(), force = f.head<3>(),
                        torque = f.tail<3>();
  Vector6d out;
  out << w.cross(force), w.cross(torque) + lin.cross(force);
  return out;
}

void TreeDynamics::place(const World& world, const Articulation& tree) {
  tree_ = &tree;
  about_ = center(world, tree);
  com_.resize(tree.bodies.size());
  own_.assign(tree.joints.size() + 1, {});
  carried_.clear();
  for (size_t i = 0; i < tree.bodies.size(); ++i) {
    const TreeBody& part = tree.bodies[i];
    const Body& body = world.body(part.body);
    const Pose& X_WB = world.pose(part.body);
    com_[i] = X_WB * body.com;
    own_[part.joint + 1].add(SpatialInertia::of(body, X_WB, about_));
    if (body.gravity_compensation == 0) continue;
    carried_.resize(own_.size());
    const double mass = body.gravity_compensation * body.mass;
    carried_[part.joint + 1].add({mass, mass * (com_[i] - about_)});
  }
  if (tree.is_free_body()) {
    M_.setZero(6, 6);
    M_.diagonal().head<3>().setConstant(own_[0].mass);
    M_.bottomRightCorner<3, 3>() = own_[0].turning;
    return;
  }
  place_joints(world);
  find_mass_matrix();
}

void TreeDynamics::place_joints(const World& world) {
  S_.resize(tree_->joints.size());
  Id<Robot> framed;
  for (size_t i = 0; i < S_.size(); ++i) {
    const ArticulationJoint& joint = tree_->joints[i];
    const Robot& robot = world.robot(joint.robot);
    if (joint.robot != framed) {
      framed = joint.robot;
      const auto q = world.joints(framed);
      find_frames(robot, world.pose(robot.base), {q.data(), robot.joints.size()}, frames_);
    }
    const Eigen::Vector3d axis = frames_.axis(robot, joint.joint).normalized();
    if (joint.slides)
      S_[i] << axis, Eigen::Vector3d::Zero();
    else
      S_[i] << (frames_.joints[joint.joint].position - about_).cross(axis), axis;
  }
}

void TreeDynamics::find_mass_matrix() {
  const auto& joints = tree_->joints;
  all_ = own_;
  for (size_t i = joints.size(); i-- > 0;) all_[joints[i].parent + 1].add(all_[i + 1]);
  const int n = tree_->size();
  M_.setZero(n, n);
  for (size_t j = 0; j < joints.size(); ++j) {
    const Vector6d momentum = joints[j].ratio * (all_[j + 1] * S_[j]);
    const int cj = joints[j].coordinate;
    for (int i = static_cast<int>(j); i >= 0; i = joints[i].parent) {
      const double m = joints[i].ratio * S_[i].dot(momentum);
      M_(joints[i].coordinate, cj) += m;
      if (i != static_cast<int>(j)) M_(cj, joints[i].coordinate) += m;
    }
    if (tree_->floating) {
      M_.block<6, 1>(0, cj) += momentum;
      M_.block<1, 6>(cj, 0) += momentum.transpose();
    }
  }
  if (!tree_->floating) return;
  Vector6d unit;
  for (int k = 0; k < 6; ++k) M_.block<6, 1>(0, k) = all_[0] * (unit.setZero(), unit[k] = 1, unit);
}

// by joint + 1: wrench required on what the joint carries directly
void TreeDynamics::find_forces(const Eigen::VectorXd& v, const Eigen::VectorXd* change,
                               const Vector6d& root_twist, const Eigen::Vector3d& gravity) {
  const auto& joints = tree_->joints;
  velocity_.resize(joints.size() + 1);
  acceleration_.resize(joints.size() + 1);
  force_.resize(joints.size() + 1);
  velocity_[0] = tree_->floating ? Vector6d(v.segment<6>(tree_->first)) : root_twist;
  acceleration_[0].setZero();
  // acceleration of the root's center of mass; seen from a fixed point, its surroundings accelerate
  // in the opposite direction
  if (tree_->floating && change) acceleration_[0] = change->segment<6>(tree_->first);
  acceleration_[0].head<3>() -= velocity_[0].tail<3>().cross(velocity_[0].head<3>());
  for (size_t i = 0; i < joints.size(); ++i) {
    const int c = tree_->first + joints[i].coordinate;
    const Vector6d moved = (joints[i].ratio * v[c]) * S_[i];
    velocity_[i + 1] = velocity_[joints[i].parent + 1] + moved;
    acceleration_[i + 1] =
        acceleration_[joints[i].parent + 1] + cross_motion(velocity_[i + 1], moved);
    if (change) acceleration_[i + 1] += (joints[i].ratio * (*change)[c]) * S_[i];
  }
  for (size_t i = 0; i <= joints.size(); ++i) {
    force_[i] = own_[i] * acceleration_[i] + cross_force(velocity_[i], own_[i] * velocity_[i]);
    force_[i].head<3>() -= own_[i].mass * gravity;
    force_[i].tail<3>() -= own_[i].moment.cross(gravity);
    if (carried_.empty()) continue;
    force_[i].head<3>() += carried_[i].mass * gravity;
    force_[i].tail<3>() += carried_[i].moment.cross(gravity);
  }
}

const Eigen::VectorXd& TreeDynamics::find_bias(const Eigen::VectorXd& v, const Vector6d& root_twist,
                                               const Eigen::Vector3d& gravity) {
  bias_.setZero(tree_->size());
  coasting_.setZero();
  if (tree_->is_free_body()) {
    bias_.head<3>() = -own_[0].mass * gravity;
    if (!carried_.empty()) {
      bias_.head<3>() += carried_[0].mass * gravity;
      bias_.tail<3>() += carried_[0].moment.cross(gravity);
    }
    return bias_;
  }
  if (!tree_->floating) {
    add_bias(v, root_twist, gravity);
    return bias_;
  }
  add_bias(v, root_twist, Eigen::Vector3d::Zero());
  coasting_ = coasting_acceleration(bias_.head<6>());
  bias_ += M_.leftCols<6>() * coasting_;
  bias_.head<6>().setZero();
  add_bias(Eigen::VectorXd::Zero(v.size()), root_twist, gravity);
  return bias_;
}

void TreeDynamics::add_bias(const Eigen::VectorXd& v, const Vector6d& root_twist,
                            const Eigen::Vector3d& gravity) {
  const auto& joints = tree_->joints;
  find_forces(v, nullptr, root_twist, gravity);
  for (size_t i = joints.size(); i-- > 0;) {
    bias_[joints[i].coordinate] += joints[i].ratio * S_[i].dot(force_[i + 1]);
    force_[joints[i].parent + 1] += force_[i + 1];
  }
  if (tree_->floating) bias_.head<6>() += force_[0];
}

// Acceleration of a root whose tree conserves momentum while its joints keep their velocities.
// bias  velocity-dependent forces on the root
Vector6d TreeDynamics::coasting_acceleration(const Vector6d& bias) const {
  return root_velocity(-bias, Eigen::VectorXd::Zero(tree_->size()));
}

Vector6d TreeDynamics::momentum(const Eigen::Ref<const Eigen::VectorXd>& v) const {
  return M_.topRows<6>() * v;
}

Vector6d TreeDynamics::root_velocity(const Vector6d& momentum,
                                     const Eigen::Ref<const Eigen::VectorXd>& v) const {
  const Eigen::Index joints = v.size() - 6;
  DenseCholesky root;
  if (!root.factor(M_.topLeftCorner<6, 6>())) return v.head<6>();  // it has no mass
  return root.solve(momentum - M_.topRightCorner(6, joints) * v.tail(joints));
}

const std::vector<double>& TreeDynamics::inverse_dynamics(const Eigen::VectorXd& v,
                                                          const Eigen::VectorXd& change,
                                                          const Vector6d& root_twist,
                                                          const Eigen::Vector3d& gravity,
                                                          const std::vector<Vector6d>& loads) {
  const auto& joints = tree_->joints;
  joint_efforts_.assign(joints.size(), 0);
  if (tree_->is_free_body()) return joint_efforts_;
  if (tree_->floating) {
    bias_.setZero(tree_->size());
    add_bias(v, root_twist, Eigen::Vector3d::Zero());
    Eigen::VectorXd all = change;
    all.segment<6>(tree_->first) += coasting_acceleration(bias_.head<6>());
    find_forces(v, &all, root_twist, gravity);
  } else {
    find_forces(v, &change, root_twist, gravity);
  }
  for (size_t b = 0; b < loads.size(); ++b) force_[tree_->bodies[b].joint + 1] -= loads[b];
  for (size_t i = joints.size(); i-- > 0;) {
    joint_efforts_[i] = S_[i].dot(force_[i + 1]);
    force_[joints[i].parent + 1] += force_[i + 1];
  }
  return joint_efforts_;
}

Eigen::VectorXd TreeDynamics::weight(const World& world) const {
  const auto& joints = tree_->joints;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(tree_->size());
  const auto carry = [&](int joint, double mass, const Eigen::Vector3d& moment) {
    Vector6d force;
    force << mass * world.gravity(), moment.cross(world.gravity());
    out[joints[joint].coordinate] -= joints[joint].ratio * S_[joint].dot(force);
  };
  for (int i = 0; i < static_cast<int>(joints.size()); ++i)
    carry(i, all_[i + 1].mass, all_[i + 1].moment);
  for (size_t b = 0; b < tree_->bodies.size(); ++b) {
    const TreeBody& part = tree_->bodies[b];
    const Body& body = world.body(part.body);
    const double mass = body.mass * (part.welded ? 1 : body.gravity_compensation);
    if (mass != 0)
      for (int i = part.joint; i >= 0; i = joints[i].parent)
        carry(i, -mass, -mass * (com_[b] - about_));
  }
  return out;
}

Eigen::VectorXd TreeDynamics::base_impulse(const Vector6d& change) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(tree_->size());
  for (size_t i = 0; i < tree_->joints.size(); ++i)
    out[tree_->joints[i].coordinate] -= tree_->joints[i].ratio * S_[i].dot(all_[i + 1] * change);
  return out;
}

void TreeDynamics::factor(const Eigen::VectorXd& added, const Eigen::MatrixXd& added_to_root) {
  const int n = tree_->size();
  L_.resize(n, n);
  L_ = M_;
  L_.diagonal() += added;
  root_is_coupled_ = added_to_root.size() > 0;
  if (root_is_coupled_) L_.topLeftCorner<6, 6>() += added_to_root;
  // the textbook algorithm, by columns: n is about ten
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k)
      if (const double x = L_(j, k); x != 0) L_.col(j).tail(n - j) -= x * L_.col(k).tail(n - j);
    // a coordinate with nearly no mass moves as if it had some
    const double pivot = std::max(L_(j, j), 1e-13 * std::max(M_(j, j), 1e-3));
    L_.col(j).tail(n - j) /= std::sqrt(pivot);
    L_(j, j) = std::sqrt(pivot);
  }
}

void TreeDynamics::half_solve(Eigen::Ref<Eigen::MatrixXd> B) const {
  if (tree_->is_free_body() && !root_is_coupled_) {
    B.topRows<3>() /= L_(0, 0);
    B.row(3) /= L_(3, 3);
    B.row(4) = (B.row(4) - L_(4, 3) * B.row(3)) / L_(4, 4);
    B.row(5) = (B.row(5) - L_(5, 3) * B.row(3) - L_(5, 4) * B.row(4)) / L_(5, 5);
    return;
  }
  L_.triangularView<Eigen::Lower>().solveInPlace(B);
}

void TreeDynamics::other_half_solve(Eigen::Ref<Eigen::VectorXd> x) const {
  L_.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
}

void TreeDynamics::add_linear(int body, const Eigen::Vector3d& p_W,
                              const Eigen::Vector3d& direction, double sign,
                              Eigen::Ref<Eigen::VectorXd> column) const {
  const Eigen::Vector3d force = sign * direction, torque = (p_W - about_).cross(force);
  if (tree_->floating) {
    column.head<3>() += force;
    column.segment<3>(3) += torque;
  }
  for (int j = tree_->bodies[body].joint; j >= 0; j = tree_->joints[j].parent)
    column[tree_->joints[j].coordinate] +=
        tree_->joints[j].ratio * (S_[j].head<3>().dot(force) + S_[j].tail<3>().dot(torque));
}

void TreeDynamics::add_angular(int body, const Eigen::Vector3d& direction, double sign,
                               Eigen::Ref<Eigen::VectorXd> column) const {
  const Eigen::Vector3d torque = sign * direction;
  if (tree_->floating) column.segment<3>(3) += torque;
  for (int j = tree_->bodies[body].joint; j >= 0; j = tree_->joints[j].parent)
    column[tree_->joints[j].coordinate] += tree_->joints[j].ratio * S_[j].tail<3>().dot(torque);
}

Vector6d TreeDynamics::motion(int body, const Eigen::Ref<const Eigen::VectorXd>& v,
                              const Vector6d& root_twist) const {
  Vector6d out = tree_->floating ? Vector6d(v.head<6>()) : root_twist;
  for (int j = tree_->bodies[body].joint; j >= 0; j = tree_->joints[j].parent)
    out += (tree_->joints[j].ratio * v[tree_->joints[j].coordinate]) * S_[j];
  return out;
}

Twist TreeDynamics::twist(int body, const Eigen::Ref<const Eigen::VectorXd>& v,
                          const Vector6d& root_twist) const {
  const Vector6d m = motion(body, v, root_twist);
  const Eigen::Vector3d w = m.tail<3>();
  return {m.head<3>() + w.cross(com_[body] - about_), w};
}

}  // namespace clench
