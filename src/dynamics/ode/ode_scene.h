// A world for ODE: one of its bodies for all bodies that a joint moves together, its hinges and
// sliders, and contacts.
#pragma once
#include <ode/ode.h>

#include <memory>

#include "clench/dynamics/ode/ode_problem.h"

namespace clench {

struct OdeDelete {
  void operator()(dWorldID world) const { dWorldDestroy(world); }
};

/// A rigid group, with axes parallel to the world's.
struct OdeNode {
  dBodyID body = nullptr;  ///< null: fixed
  bool free = false;       ///< is it moved by forces? otherwise its motion is prescribed
  double mass = 0;
  Eigen::Vector3d com = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();                         ///< about com [kg m^2]
  Eigen::Vector3d v = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero();  ///< before the step
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero(),
                  turning = Eigen::Vector3d::Zero();  ///< caused by joints at constant speed
  Eigen::Vector3d force = Eigen::Vector3d::Zero(),
                  torque = Eigen::Vector3d::Zero();  ///< in the step
};

struct OdeJoint {
  dJointID joint = nullptr;
  int child = 0, parent = 0;  ///< nodes
  Eigen::Vector3d origin, axis;
  bool slides = false;
};

/// One tree of the system.
struct OdeTree {
  std::vector<OdeNode> nodes;  ///< the root first, then by joint
  std::vector<OdeJoint> joints;
  /// by coordinate: the joint that represents it; -1: one of the six, or none
  std::vector<int> lead;
};

class OdeScene {
 public:
  /// softness  compliance of contacts, as a fraction of an impulse's effect on a body: the forces
  ///           at four corners that carry a box are not unique
  OdeScene(const World& world, const OdeProblem& problem, double h, double softness);

  void add_row(const CoordinateRow& row);
  void add_contact(const OdeContact& contact);
  /// A torque about, or a force along, a joint's axis in the following steps.
  void push(int tree, int joint, double effort);
  /// Steps from the world's state, independent of earlier steps.
  void step();
  /// Makes the following steps by dWorldQuickStep, which iterates (projected successive
  /// overrelaxation) and never fails, instead of dWorldStep.
  void iterate() { iterates_ = true; }

  double joint_velocity(int tree, int joint) const;
  double row_impulse(int row) const;
  void read_contact(const OdeContact& contact, int number, OdeSolution& out) const;
  Twist root_twist(int tree) const;  ///< of a floating root, at its center of mass
  const std::vector<OdeTree>& trees() const { return trees_; }

 private:
  struct Row {
    int tree, joint;
    double ratio;
    std::unique_ptr<dJointFeedback> feedback;
    bool stop;  // a limit: its torque is the joint's own
  };
  struct TouchFeedback {
    bool made = false, turned = false;  // reversed: a is ODE's first body
    std::unique_ptr<dJointFeedback> feedback;
  };

  void add_tree(const Articulation& tree, int number);
  void find_motion(const Articulation& tree, int number);
  void add_joint(const ArticulationJoint& joint, const Eigen::Vector3d& origin,
                 const Eigen::Vector3d& axis, OdeTree& out);
  void make_body(OdeNode& node);
  void base_impulse(const Articulation& tree, int number);
  void add_forces(const Articulation& tree, int number);
  void damp_root(const Articulation& tree, int number);
  dJointID add_motor(const OdeTree& tree, const OdeJoint& joint, double velocity, double cfm,
                     double most);
  const OdeNode* node_of(Id<Body> id) const;
  static Eigen::Vector3d velocity_of(const OdeNode& node);  // after a step
  static Eigen::Vector3d turning_of(const OdeNode& node);
  Eigen::Vector3d velocity_at(Id<Body> id, const Eigen::Vector3d& p_W) const;

  const World& world_;
  const OdeProblem& problem_;
  double h_, softness_;
  bool iterates_ = false;
  std::unique_ptr<dxWorld, OdeDelete> ode_;
  std::vector<OdeTree> trees_;
  std::vector<OdeNode> obstacle_nodes_;  // obstacles that move, by the index of the body's id
  std::vector<Row> rows_;
  std::vector<TouchFeedback> touches_;
};

}  // namespace clench
