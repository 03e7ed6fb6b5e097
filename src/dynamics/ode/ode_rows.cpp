// Rows of a step as ODE's motors, stops and contacts, and their solution.
#include <algorithm>
#include <cmath>

#include "clench/dynamics/ode/ode_scene.h"

namespace clench {

// Tolerance by which joints may pass their stops, larger for each than for the one before [rad/s,
// m/s]: Dantzig's method fails at ties, and a joint at its stop is one.
static constexpr double stop_slack = 1e-12;

static Eigen::Vector3d vector_of(const dReal* x) { return {x[0], x[1], x[2]}; }

Eigen::Vector3d OdeScene::velocity_of(const OdeNode& node) {
  return node.body ? vector_of(dBodyGetLinearVel(node.body)) : Eigen::Vector3d(0, 0, 0);
}

Eigen::Vector3d OdeScene::turning_of(const OdeNode& node) {
  return node.body ? vector_of(dBodyGetAngularVel(node.body)) : Eigen::Vector3d(0, 0, 0);
}

dJointID OdeScene::add_motor(const OdeTree& tree, const OdeJoint& joint, double velocity,
                             double cfm, double most) {
  const dBodyID child = tree.nodes[joint.child].body, parent = tree.nodes[joint.parent].body;
  const Eigen::Vector3d& x = joint.axis;
  dJointID motor;
  if (joint.slides) {
    motor = dJointCreateLMotor(ode_.get(), nullptr);
    dJointAttach(motor, child, parent);
    dJointSetLMotorNumAxes(motor, 1);
    dJointSetLMotorAxis(motor, 0, 0, x.x(), x.y(), x.z());
    dJointSetLMotorParam(motor, dParamVel, velocity);
    dJointSetLMotorParam(motor, dParamFMax, most);
    dJointSetLMotorParam(motor, dParamCFM, cfm);
  } else {
    motor = dJointCreateAMotor(ode_.get(), nullptr);
    dJointAttach(motor, child, parent);
    dJointSetAMotorNumAxes(motor, 1);
    dJointSetAMotorAxis(motor, 0, 0, x.x(), x.y(), x.z());
    dJointSetAMotorParam(motor, dParamVel, velocity);
    dJointSetAMotorParam(motor, dParamFMax, most);
    dJointSetAMotorParam(motor, dParamCFM, cfm);
  }
  return motor;
}

void OdeScene::add_row(const CoordinateRow& row) {
  const OdeTree& tree = trees_[row.tree];
  // ODE has no joint that acts on several coordinates, or on the six coordinates of a root
  const int lead = row.arms.empty() ? tree.lead[row.coordinate] : -1;
  rows_.push_back({row.tree, lead, 1, std::make_unique<dJointFeedback>(), false});
  if (lead < 0) return;
  Row& made = rows_.back();
  const OdeJoint& joint = tree.joints[lead];
  made.ratio = problem_.system.trees[row.tree].joints[lead].ratio;
  *made.feedback = {};
  if (row.kind != RowKind::low_limit && row.kind != RowKind::high_limit) {
    // ODE bounds a motor symmetrically: by the bound in the direction of its target
    const double bound = row.target < 0   ? -row.low
                         : row.target > 0 ? row.high
                                          : std::min(-row.low, row.high);
    const double most = bound < dInfinity ? bound / h_ / std::abs(made.ratio) : dInfinity;
    if (most <= 0) return;
    const dJointID motor = add_motor(tree, joint, made.ratio * row.target,
                                     h_ * made.ratio * made.ratio * row.compliance, most);
    return dJointSetFeedback(motor, made.feedback.get());
  }
  // ODE corrects the error of a stop at the velocity error * ERP / h: with an error of 1, ERP / h is
  // the target velocity of the row
  made.stop = true;
  const bool low = (row.kind == RowKind::low_limit) == (made.ratio > 0);
  const double target = made.ratio * row.target;
  const auto set = [&](int parameter, double value) {
    joint.slides ? dJointSetSliderParam(joint.joint, parameter, value)
                 : dJointSetHingeParam(joint.joint, parameter, value);
  };
  const auto get = [&](int parameter) {
    return joint.slides ? dJointGetSliderParam(joint.joint, parameter)
                        : dJointGetHingeParam(joint.joint, parameter);
  };
  // ODE stops a joint on one side at a time: the nearer one
  if (get(low ? dParamHiStop : dParamLoStop) == (low ? -1 : 1)) {
    if (std::abs(get(dParamStopERP)) < std::abs(target * h_)) return;
    set(low ? dParamHiStop : dParamLoStop, low ? dInfinity : -dInfinity);
  }
  set(low ? dParamLoStop : dParamHiStop, low ? 1 : -1);
  set(dParamStopERP,
      ((low ? target : -target) - stop_slack * static_cast<double>(rows_.size())) * h_);
  dJointSetFeedback(joint.joint, made.feedback.get());
}

const OdeNode* OdeScene::node_of(Id<Body> id) const {
  const System::Place place = problem_.system.place(id);
  if (place.tree < 0) return obstacle_nodes_[id.index].body ? &obstacle_nodes_[id.index] : nullptr;
  const OdeNode& node =
      trees_[place.tree].nodes[problem_.system.trees[place.tree].bodies[place.body].joint + 1];
  return node.body ? &node : nullptr;
}

void OdeScene::add_contact(const OdeContact& contact) {
  touches_.emplace_back();
  TouchFeedback& touch = touches_.back();
  touch.feedback = std::make_unique<dJointFeedback>();
  const OdeNode *a = node_of(contact.a), *b = node_of(contact.b);
  const bool a_free = a && a->free, b_free = b && b->free;
  if (a == b || (!a_free && !b_free)) return;
  // the first body; the normal points into it
  touch.turned = !b;
  const double side = touch.turned ? -1 : 1;
  const Eigen::Vector3d normal = contact.frame.col(0);
  Eigen::Vector3d slide = contact.frame.rightCols<2>() * contact.free_velocity.tail<2>();
  slide = slide.norm() > 1e-9 ? Eigen::Vector3d(slide.normalized())
                              : Eigen::Vector3d(contact.frame.col(1));
  const Eigen::Vector3d across = normal.cross(slide);
  dContact made{};
  made.surface.mode = dContactFDir1 | dContactMotionN | dContactMotion1 | dContactMotion2 |
                      dContactApprox1 | dContactAxisDep | dContactSoftCFM |
                      (contact.spin_radius > 0 ? dContactRolling : 0);
  made.surface.mu = made.surface.mu2 = contact.mu;
  made.surface.rhoN = contact.spin_radius;
  made.surface.motionN = contact.target;
  made.surface.motion1 = -slide.dot(contact.surface_velocity);
  made.surface.motion2 = -side * across.dot(contact.surface_velocity);
  made.surface.soft_cfm =
      softness_ * h_ * ((a_free ? 1 / a->mass : 0) + (b_free ? 1 / b->mass : 0));
  for (int k = 0; k < 3; ++k) {
    made.geom.pos[k] = contact.p_W[k];
    made.geom.normal[k] = side * normal[k];
    made.fdir1[k] = side * slide[k];
  }
  const dJointID joint = dJointCreateContact(ode_.get(), nullptr, &made);
  dJointAttach(joint, touch.turned ? a->body : b->body,
               touch.turned ? nullptr : (a ? a->body : nullptr));
  dJointSetFeedback(joint, touch.feedback.get());
  touch.made = true;
}

double OdeScene::joint_velocity(int tree, int number) const {
  const OdeTree& t = trees_[tree];
  const OdeJoint& joint = t.joints[number];
  const OdeNode &child = t.nodes[joint.child], &parent = t.nodes[joint.parent];
  if (!joint.slides) return joint.axis.dot(turning_of(child) - turning_of(parent));
  const Eigen::Vector3d carried =
      velocity_of(parent) + turning_of(parent).cross(child.com - parent.com);
  return joint.axis.dot(velocity_of(child) - carried);
}

double OdeScene::row_impulse(int number) const {
  const Row& row = rows_[number];
  if (row.joint < 0) return 0;
  const OdeTree& tree = trees_[row.tree];
  const OdeJoint& joint = tree.joints[row.joint];
  const Eigen::Vector3d f = vector_of(row.feedback->f1), t = vector_of(row.feedback->t1);
  // the force of a hinge has a lever arm
  const Eigen::Vector3d arm = joint.origin - tree.nodes[joint.child].com;
  double effort = joint.axis.dot(joint.slides ? f : t);
  if (row.stop && !joint.slides) effort -= joint.axis.dot(arm.cross(f));
  return h_ * row.ratio * effort;
}

Eigen::Vector3d OdeScene::velocity_at(Id<Body> id, const Eigen::Vector3d& p_W) const {
  const OdeNode* node = node_of(id);
  if (!node) return Eigen::Vector3d::Zero();
  return velocity_of(*node) + turning_of(*node).cross(p_W - node->com);
}

void OdeScene::read_contact(const OdeContact& contact, int number, OdeSolution& out) const {
  const TouchFeedback& touch = touches_[number];
  const Eigen::Vector3d relative = velocity_at(contact.b, contact.p_W) -
                                   velocity_at(contact.a, contact.p_W) + contact.surface_velocity;
  out.velocities.push_back(contact.frame.transpose() * relative);
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  double spin = 0;
  if (touch.made) {
    const OdeNode& first = *node_of(touch.turned ? contact.a : contact.b);
    const double side = touch.turned ? -1 : 1;
    const Eigen::Vector3d f = vector_of(touch.feedback->f1), t = vector_of(touch.feedback->t1);
    impulse = side * h_ * (contact.frame.transpose() * f);
    spin = side * h_ * contact.frame.col(0).dot(t - (contact.p_W - first.com).cross(f));
  }
  out.impulses.push_back(impulse);
  out.spins.push_back(spin);
}

}  // namespace clench
